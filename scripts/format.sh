#!/usr/bin/env bash
# Formats every C++ file with clang-format; with --check it changes nothing, and fails if it would change a file.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "") options=(-i) ;;
  --check) options=(--dry-run --Werror) ;;
  *) echo "usage: format.sh [--check]" >&2; exit 1 ;;
esac
find apps ceres_ed cost_functions data test \( -name '*.h' -o -name '*.cc' \) -print0 |
  xargs -0 -r clang-format "${options[@]}"
