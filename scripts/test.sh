#!/usr/bin/env bash
# Builds everything and runs every test: test.sh [PRESET (release)]. Ends with "N passed, N failed".
# test.sh PRESET FOLDER ... builds and runs only the tests of some folders of test/: test.sh asan io solver
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
folders=("${@:2}")
for folder in "${folders[@]}"; do
  if [[ ! -f test/$folder/CMakeLists.txt ]]; then
    echo "test.sh: there is no folder test/$folder" >&2
    exit 1
  fi
done
targets=()
labels=()
if [[ ${#folders[@]} -gt 0 ]]; then
  targets=(--target "${folders[@]/#/tests_}")
  labels=(--label-regex "^($(IFS='|'; echo "${folders[*]}"))\$")
fi

scripts/setup.sh test
scripts/configure.sh "$preset" -DCERES_ED_BUILD_TESTS=ON -DCERES_ED_BUILD_APPS=ON
cmake --build "build/$preset" --parallel "$(nproc)" "${targets[@]}"

log=build/$preset/ctest.log
status=0
(cd "build/$preset" && ctest --output-on-failure --no-tests=error --parallel "$(nproc)" "${labels[@]}") |
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
