#!/usr/bin/env bash
# Fits every sample pair, tracks a small simulated sequence, and measures both against the truth:
#   scripts/demo.sh        builds the programs first (minutes, once); results go to build/demo/
#   ceres_ed_demo [FOLDER]  the same script where ceres_ed is installed; results go to ./ceres_ed_demo/
# With --fits in front it ends after the fits, and installs about half as much.
# If the environment variable CERES_ED_BIN names a folder, the programs in it are used, and nothing is built.
set -euo pipefail
fits_only=
if [[ ${1:-} == --fits ]]; then
  fits_only=1
  shift
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
apps=${CERES_ED_BIN:+$(cd "$CERES_ED_BIN" && pwd)}
if [[ -f $here/../CMakeLists.txt ]]; then
  cd "$here/.."
  data=data
  results=${1:-build/demo}
else
  data=$(dirname "$here")/share/ceres_ed/data
  results=${1:-ceres_ed_demo}
  apps=${apps:-$here}
fi

say() { printf '\n== %s\n' "$*"; }

# number JSON_FILE OBJECT FIELD: prints the number FIELD of the top-level object OBJECT, or - if there is none.
number() {
  awk -v object="\"$2\": {" -v field="\"$3\":" '
    index($0, "  " object) == 1 { inside = 1 }
    inside && index($0, field) { gsub(/[",]/, ""); print $2; found = 1; exit }
    inside && /^  }/ { exit }
    END { if (!found) print "-" }' "$1"
}

# build_programs LIST NAME ...: installs the packages of LIST and builds programs, unless they were named.
build_programs() {
  if [[ -n $apps ]]; then return; fi
  say "packages for ${*:2}"
  scripts/setup.sh "$1"
  say "programs (the first time takes a few minutes)"
  scripts/configure.sh release
  cmake --build build/release --parallel "$(nproc)" --target "${@:2}"
}

build_programs fit ed_fit ed_eval
programs=${apps:-build/release/apps}

rows=()
for source in "$data"/*/source.ply; do
  folder=$(dirname "$source")
  pair=$(basename "$folder")
  out=$results/$pair
  mkdir -p "$out"
  say "$pair: fit $source to $folder/target.ply"
  "$programs/ed_fit" "$source" "$folder/target.ply" --output="$out/fitted.ply" \
    --warp="$out/warp.json" --report="$out/fit.json"
  truth=()
  if [[ -f $folder/gt.ply ]]; then truth=(--truth="$folder/gt.ply"); fi
  "$programs/ed_eval" "$out/fitted.ply" "$folder/target.ply" --source="$source" "${truth[@]}" \
    --report="$out/eval.json" --error_ply="$out/error.ply"
  rows+=("$pair $(number "$out/eval.json" backward mean_percent) \
    $(number "$out/eval.json" truth mean_percent) $(number "$out/fit.json" time_s total)")
done

# The distance is measured from the target: when the target is a partial view, most of the result has no
# counterpart in it.
say "mean distances in percent of the target's diagonal, and time; results are in $results/"
printf '%-18s %18s %18s %10s\n' pair "target to result" "result to truth" seconds
for row in "${rows[@]}"; do
  read -r pair surface truth seconds <<<"$row"
  for value in surface truth seconds; do
    if [[ ${!value} != - ]]; then printf -v "$value" '%.3f' "${!value}"; fi
  done
  printf '%-18s %18s %18s %10s\n' "$pair" "$surface" "$truth" "$seconds"
done

if [[ -n $fits_only ]]; then exit 0; fi

# The packages that read pictures are as large as all others together, so a fit does not wait for them.
build_programs tracking ed_slam ed_simulate ed_eval
sequence=$results/heart
say "a camera circles a beating heart: simulate, track, measure"
"$programs/ed_simulate" heart --output="$sequence" --frames=20 --width=320 --height=240 --overwrite
"$programs/ed_slam" "$sequence" --output="$sequence-tracked" --overwrite
"$programs/ed_eval" --sequence="$sequence" --result="$sequence-tracked" \
  --report="$sequence-tracked/eval.json"

say "what to open"
cat <<END
Open these PLY files with MeshLab or CloudCompare (Debian packages meshlab, cloudcompare):
  $results/PAIR/fitted.ply    the deformed source; open $data/PAIR/target.ply beside it
  $results/PAIR/error.ply     the same, coloured by the distance of each point to its true place:
                              blue is small, white is medium, red is the 95th percentile or more
  $sequence-tracked/map.ply   the heart as the tracker has it after the last frame
  $sequence-tracked/live/     the map in every frame, as the camera sees it
END
say "figures that look alarming, and are not"
cat <<END
- In heart, kidney and stomach_partial the target shows 40 to 45 % of the surface. "target to result"
  measures this part. "result to target" and "result to truth" include the hidden part, which no data
  determine: about 1.5 % to the truth is what can be expected. For the same reason a third of the matches
  are no inliers.
- "verdict" judges a result by what can be measured without the truth: good, doubtful or bad, with reasons.
- Tracking: camera and tissue can exchange a motion that the whole view shares, so the camera may be off
  by millimetres while each map point stays within a fraction of a millimetre of its tissue ("tracking,
  seen"). Hidden points are predicted, and their errors are larger.
END
