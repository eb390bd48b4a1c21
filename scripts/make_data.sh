#!/bin/sh
# Remakes the sample pairs: scripts/make_data.sh [BUILD_DIR] [OUTPUT_DIR]
# BUILD_DIR (default build/release) is configured if it isn't yet; OUTPUT_DIR defaults to data/.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build/release}
output=${2:-$root/data}
[ -f "$build/CMakeCache.txt" ] || cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release
cmake --build "$build" --target make_pairs
"$build/data/make_pairs" "$output"
