#!/usr/bin/env bash
# Builds everything and runs every test: test.sh [PRESET (release)]. Ends with "N passed, N failed".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
scripts/setup.sh test
scripts/configure.sh "$preset" -DCERES_ED_BUILD_TESTS=ON -DCERES_ED_BUILD_APPS=ON
cmake --build "build/$preset" --parallel "$(nproc)"

log=build/$preset/ctest.log
status=0
(cd "build/$preset" && ctest --output-on-failure --no-tests=error --parallel "$(nproc)") |
  tee "$log" || status=$?
# "100% tests passed, 0 tests failed out of 50"
summary=$(grep -E '[0-9]+ tests? failed out of [0-9]+' "$log" || true)
if [[ $summary =~ ([0-9]+)\ tests?\ failed\ out\ of\ ([0-9]+) ]]; then
  failed=${BASH_REMATCH[1]}
  echo "$((BASH_REMATCH[2] - failed)) passed, $failed failed"
else
  echo "0 passed, 0 failed: ctest did not run" >&2
  [[ $status -ne 0 ]] || status=1
fi
exit "$status"
