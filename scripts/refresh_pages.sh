#!/usr/bin/env bash
# Brings pages up to date: the catalogue of energies, source files that are shown in full, and the short tables
# of the README.
# refresh_pages.sh [BUILD FOLDER (build/release)]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=${1:-build/release}
page=ceres_ed/energy/README.md
cmake --build "$build" --target ed_list_energies
catalogue=$(mktemp)
trap 'rm -f "$catalogue"' EXIT
"$build/apps/ed_list_energies" --format=markdown >"$catalogue"
sed -i -e '/^<!-- ed_list_energies: begin -->$/,/^<!-- ed_list_energies: end -->$/{
  /begin -->$/!{/end -->$/!d}
  /begin -->$/r '"$catalogue"'
}' "$page"
python3 test/docs/check_code.py --update
scripts/readme_tables.py
echo "refreshed $page, README.md and the pages that show files"
