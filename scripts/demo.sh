#!/usr/bin/env bash
# Fits every pair in data/, tracks a small simulated sequence, and measures both against the truth. The
# first run builds the programs; the next ones take seconds. Results go to build/demo/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# number JSON_FILE OBJECT FIELD: the number FIELD of the top-level object OBJECT; - where there is none.
number() {
  awk -v object="\"$2\": {" -v field="\"$3\":" '
    index($0, "  " object) == 1 { inside = 1 }
    inside && index($0, field) { gsub(/[",]/, ""); print $2; found = 1; exit }
    inside && /^  }/ { exit }
    END { if (!found) print "-" }' "$1"
}

say "packages"
scripts/setup.sh
say "programs (the first time takes a few minutes)"
scripts/configure.sh release
cmake --build build/release --parallel "$(nproc)" --target ed_fit ed_eval ed_slam ed_simulate

apps=build/release/apps
rows=()
for source in data/*/source.ply; do
  pair=$(basename "$(dirname "$source")")
  folder=data/$pair
  out=build/demo/$pair
  mkdir -p "$out"
  say "$pair: fit $source to $folder/target.ply"
  "$apps/ed_fit" "$source" "$folder/target.ply" --output="$out/fitted.ply" \
    --warp="$out/warp.json" --report="$out/fit.json"
  truth=()
  if [[ -f $folder/gt.ply ]]; then truth=(--truth="$folder/gt.ply"); fi
  "$apps/ed_eval" "$out/fitted.ply" "$folder/target.ply" --source="$source" "${truth[@]}" \
    --report="$out/eval.json" --error_ply="$out/error.ply"
  rows+=("$pair $(number "$out/eval.json" backward mean_percent) \
    $(number "$out/eval.json" truth mean_percent) $(number "$out/fit.json" time_s total)")
done

# From the target, for most of a result has no counterpart where the target is a partial view.
say "mean distances in percent of the target's diagonal, and time; results are in build/demo/"
printf '%-18s %18s %18s %10s\n' pair "target to result" "result to truth" seconds
for row in "${rows[@]}"; do
  read -r pair surface truth seconds <<<"$row"
  for value in surface truth seconds; do
    if [[ ${!value} != - ]]; then printf -v "$value" '%.3f' "${!value}"; fi
  done
  printf '%-18s %18s %18s %10s\n' "$pair" "$surface" "$truth" "$seconds"
done

sequence=build/demo/heart
say "a camera circles a beating heart: simulate, track, measure"
"$apps/ed_simulate" heart --output="$sequence" --frames=20 --width=320 --height=240 --overwrite
"$apps/ed_slam" "$sequence" --output="$sequence-tracked"
"$apps/ed_eval" --sequence="$sequence" --result="$sequence-tracked" \
  --report="$sequence-tracked/eval.json"
