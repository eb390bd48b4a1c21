#!/usr/bin/env bash
# Builds the Debian packages into build/packages/: the library, what programs are built with, the
# tools, the Python package and the modules.
# package.sh [CMAKE OPTION ...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=build/packages
scripts/setup.sh packages pcl vtk gltf video hdf5
# The date of the changelogs is that of the sources.
if date=$(git log -1 --format=%ct 2>/dev/null); then export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$date}; fi
# A folder of its own beside that of the preset: same objects, so a compiler cache serves both.
scripts/configure.sh release -B build/release-packages -DBUILD_SHARED_LIBS=ON \
  -DCMAKE_INSTALL_PREFIX=/usr -DCERES_ED_BUILD_TESTS=OFF -DCERES_ED_BUILD_APPS=ON \
  -DCERES_ED_BUILD_PYTHON=ON -DCERES_ED_BUILD_PCL=ON -DCERES_ED_BUILD_VTK=ON -DCERES_ED_BUILD_GLTF=ON \
  -DCERES_ED_BUILD_HDF5=ON \
  -DCERES_ED_PYTHON_DIR=lib/python3/dist-packages "$@"
cmake --build build/release-packages --parallel "$(nproc)"
rm -rf "$packages"
cpack --config build/release-packages/CPackConfig.cmake -B "$packages"
rm -rf "$packages/_CPack_Packages"
for package in "$packages"/*.deb; do
  printf '\n%s\n' "$package"
  # shellcheck disable=SC2016  # a field of dpkg's
  dpkg-deb --show --showformat '  depends: ${Depends}\n' "$package"
done
