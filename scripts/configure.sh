#!/usr/bin/env bash
# Configures a preset, with ccache if it is installed: configure.sh PRESET [CMAKE OPTION ...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:?usage: configure.sh PRESET [CMAKE OPTION ...]}
shift
launcher=()
# Paths are relative to the sources, so build folders share compiled objects.
if command -v ccache >/dev/null; then
  launcher=("-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_BASEDIR=$PWD;ccache")
fi
log=build/$preset-configure.log
mkdir -p build
if ! cmake --preset "$preset" "${launcher[@]}" "$@" >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
echo "configured build/$preset"
