#!/usr/bin/env bash
# Fuzzes the readers of files that users give, and then whole programs:
#   fuzz.sh MINUTES [READER ...]        the readers share four fifths of the time; then 60 runs of programs a minute
#   fuzz.sh --runs=NUMBER [READER ...]  so many executions of each reader, of short files; no programs
# As many readers run at once as there are cores, or $JOBS. Prints executions, those a second and peak memory of each.
# What crashes one is kept in build/fuzz/crashes: once mended, it belongs into test/fuzz/corpus/READER, where the
# ordinary tests replay it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

amount=${1:?usage: fuzz.sh MINUTES|--runs=NUMBER [READER ...]}
shift
readers=("$@")
scripts/setup.sh test fuzz
scripts/configure.sh fuzz
# A module whose library is missing is not built; its reader then says so, and nothing is fuzzed.
cmake --build build/fuzz --parallel "$(nproc)" --target fuzz_reader
if [[ ${#readers[@]} -eq 0 ]]; then
  for folder in test/fuzz/corpus/*/; do readers+=("$(basename "$folder")"); done
fi

jobs=${JOBS:-$(nproc)}
if [[ $amount == --runs=* ]]; then
  limit=(-runs="${amount#--runs=}" -max_len=1024)
else
  limit=(-max_total_time=$((amount * 48 * jobs / ${#readers[@]} + 1)) -max_len=8192)
fi
mkdir -p build/fuzz/crashes build/fuzz/logs
fuzz_one() {
  local reader=$1 leaks=1
  # Libraries of others keep what they take once.
  case $reader in glb | pcd | vtk | vtp) leaks=0 ;; esac
  mkdir -p "build/fuzz/found/$reader"
  # The readers read files, so these are kept in memory. OpenCV's own messages would hide the fuzzer's.
  TMPDIR=/dev/shm OPENCV_LOG_LEVEL=SILENT ASAN_OPTIONS=detect_leaks=$leaks \
    build/fuzz/test/fuzz/fuzz_reader --reader="$reader" $limit_text \
    -timeout=10 -rss_limit_mb=1000 -malloc_limit_mb=1000 \
    -artifact_prefix="build/fuzz/crashes/$reader-" -print_final_stats=1 \
    "build/fuzz/found/$reader" "test/fuzz/corpus/$reader" >"build/fuzz/logs/$reader" 2>&1
}
export -f fuzz_one
export limit_text="${limit[*]}"
status=0
printf '%s\0' "${readers[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'fuzz_one "$0"' || status=1
printf '%-18s %12s %8s %8s\n' reader executions "a second" "peak MB"
for reader in "${readers[@]}"; do
  log=build/fuzz/logs/$reader
  figure() { sed -n "s/stat::$1: *//p" "$log"; }
  printf '%-18s %12s %8s %8s\n' "$reader" "$(figure number_of_executed_units)" "$(figure average_exec_per_sec)" \
    "$(figure peak_rss_mb)"
  grep -E "^$reader: |ERROR: |runtime error: " "$log" || true
done
[[ $amount != --runs=* ]] || exit "$status"

scripts/configure.sh release -DCERES_ED_BUILD_APPS=ON
cmake --build build/release --parallel "$(nproc)"
/usr/bin/python3 scripts/fuzz_programs.py --runs=$((amount * 60)) || status=1
exit "$status"
