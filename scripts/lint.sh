#!/usr/bin/env bash
# Runs clang-tidy on the files that differ from HEAD, or with --all on every file of the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v clang-tidy >/dev/null; then
  echo "lint.sh: clang-tidy is missing: scripts/setup.sh lint" >&2
  exit 1
fi
case "${1:-}" in
  "") mapfile -t files < <(git diff --name-only --diff-filter=d HEAD -- '*.cc'
                           git ls-files --others --exclude-standard -- '*.cc')
      if [[ ${#files[@]} -eq 0 ]]; then
        echo "lint: no files to check"
        exit 0
      fi ;;
  --all) files=() ;;
  *) echo "usage: lint.sh [--all]" >&2; exit 1 ;;
esac
scripts/configure.sh dev -DCERES_ED_BUILD_BENCHMARKS=OFF
python3 scripts/lint.py build/dev "${files[@]}"
