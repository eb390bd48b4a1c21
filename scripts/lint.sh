#!/usr/bin/env bash
# Runs clang-tidy on the files that differ from HEAD, or with --all on every file of the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "") files=$(git diff --name-only --diff-filter=d HEAD -- '*.cc'; git ls-files --others --exclude-standard -- '*.cc') ;;
  --all) files=$(find apps ceres_ed data test -name '*.cc' -not -path '*/consumer/*' -not -path 'test/install/*') ;;
  *) echo "usage: lint.sh [--all]" >&2; exit 1 ;;
esac
if [[ -z $files ]]; then
  echo "lint: no files to check"
  exit 0
fi
scripts/configure.sh dev -DCERES_ED_BUILD_BENCHMARKS=OFF
printf '%s\n' "$files" | tr '\n' '\0' |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p build/dev
