#!/usr/bin/env bash
# Makes the API pages with Doxygen: docs.sh [FOLDER (build/docs)]. Fails on any warning.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v doxygen >/dev/null; then
  echo "docs.sh: doxygen is missing: apt-get install doxygen" >&2
  exit 1
fi
export CERES_ED_DOCS=${1:-build/docs}
CERES_ED_VERSION=$(sed -n 's/^project(ceres_ed VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
export CERES_ED_VERSION
mkdir -p "$CERES_ED_DOCS"
python3 scripts/doxygen/prepare.py "$CERES_ED_DOCS/source"
doxygen scripts/doxygen/Doxyfile
echo "docs: $CERES_ED_DOCS/html/index.html"
