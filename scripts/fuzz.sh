#!/usr/bin/env bash
# Fuzzes the readers of files that users give, and then whole programs: fuzz.sh MINUTES [READER ...]
# The readers share four fifths of the time, as many at once as there are cores; then come 60 runs of programs a minute.
# Prints executions and peak memory of each reader. What crashes one is kept in build/fuzz/crashes: once mended, it
# belongs into test/fuzz/corpus/READER, where the ordinary tests replay it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

minutes=${1:?usage: fuzz.sh MINUTES [READER ...]}
shift
readers=("$@")
scripts/setup.sh test fuzz
scripts/configure.sh fuzz
cmake --build build/fuzz --parallel "$(nproc)" --target fuzz_reader
if [[ ${#readers[@]} -eq 0 ]]; then
  for folder in test/fuzz/corpus/*/; do readers+=("$(basename "$folder")"); done
fi

cores=$(nproc)
seconds=$((minutes * 48 * cores / ${#readers[@]} + 1))
mkdir -p build/fuzz/crashes build/fuzz/logs
fuzz_one() {
  local reader=$1
  mkdir -p "build/fuzz/found/$reader"
  # The readers read files, so these are kept in memory. OpenCV's own messages would hide the fuzzer's.
  TMPDIR=/dev/shm OPENCV_LOG_LEVEL=SILENT build/fuzz/test/fuzz/fuzz_reader --reader="$reader" \
    -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1000 -malloc_limit_mb=1000 -max_len=8192 \
    -artifact_prefix="build/fuzz/crashes/$reader-" -print_final_stats=1 \
    "build/fuzz/found/$reader" "test/fuzz/corpus/$reader" >"build/fuzz/logs/$reader" 2>&1
}
export -f fuzz_one
export seconds
status=0
printf '%s\0' "${readers[@]}" | xargs -0 -n 1 -P "$cores" bash -c 'fuzz_one "$0"' || status=1
printf '%-18s %12s %8s\n' reader executions "peak MB"
for reader in "${readers[@]}"; do
  log=build/fuzz/logs/$reader
  printf '%-18s %12s %8s\n' "$reader" "$(sed -n 's/stat::number_of_executed_units: *//p' "$log")" \
    "$(sed -n 's/stat::peak_rss_mb: *//p' "$log")"
  grep -E "^$reader: |ERROR: |runtime error: " "$log" || true
done

scripts/configure.sh release -DCERES_ED_BUILD_APPS=ON
cmake --build build/release --parallel "$cores"
/usr/bin/python3 scripts/fuzz_programs.py --runs=$((minutes * 60)) || status=1
exit "$status"
