#!/usr/bin/env bash
# Installs what ceres_ed is built from: Debian 12 packages, only those that are missing.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache pkg-config file
  libceres-dev libeigen3-dev libsuitesparse-dev libopenblas-dev
  libgoogle-glog-dev libgflags-dev
  libnanoflann-dev nlohmann-json3-dev libpcl-dev libboost-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-video-dev
  libgtest-dev libgmock-dev
  doxygen
  python3-dev pybind11-dev python3-numpy python3-pytest python3-pil mypy
)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh: this is no Debian; install these yourself (names of Debian 12):" >&2
  echo "  ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "setup: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: run this as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
if ! "${as_root[@]}" apt-get update -q ||
  ! "${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"; then
  echo "setup.sh: apt-get failed (no network?); missing: ${missing[*]}" >&2
  exit 1
fi
