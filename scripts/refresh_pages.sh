#!/usr/bin/env bash
# Brings pages up to date: the catalogue of energies, the tables of options, source files that are shown in full,
# and the short tables of the README.
# refresh_pages.sh [BUILD FOLDER (build/release)]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=${1:-build/release}
cmake --build "$build" --target ed_list_energies ed_apply ed_fit ed_slam ed_depth
text=$(mktemp)
trap 'rm -f "$text"' EXIT

# refresh PAGE MARK COMMAND...: puts what the command prints between the marks of the page.
refresh() {
  local page=$1 mark=$2
  "${@:3}" >"$text"
  sed -i -e '/^<!-- '"$mark"': begin -->$/,/^<!-- '"$mark"': end -->$/{
    /begin -->$/!{/end -->$/!d}
    /begin -->$/r '"$text"'
  }' "$page"
  echo "refreshed $page"
}

refresh ceres_ed/energy/README.md ed_list_energies "$build/apps/ed_list_energies" --format=markdown
refresh ceres_ed/registration/README.md 'ed_fit options' "$build/apps/ed_fit" --help=markdown
refresh ceres_ed/io/field/README.md 'ed_apply options' "$build/apps/ed_apply" --help=markdown
refresh ceres_ed/stereo/README.md 'ed_depth options' "$build/apps/ed_depth" --help=markdown
refresh ceres_ed/slam/README.md 'ed_slam options' "$build/apps/ed_slam" --help=markdown
python3 test/docs/check_code.py --update
scripts/readme_tables.py
echo "refreshed README.md and the pages that show files"
