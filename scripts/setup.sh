#!/usr/bin/env bash
# Installs Debian 12 packages that ceres_ed is built from, only those that are missing:
#   setup.sh [LIST ...]   (demo)
#   fit       the library, ed_fit, ed_apply, ed_eval
#   tracking  fit, and what reads pictures: ed_slam, ed_depth, ed_simulate
#   demo      what scripts/demo.sh needs: tracking
#   python    the Python package
#   pcl       the module for PCL and .pcd files
#   vtk       the module for .vtk and .vtp files
#   gltf      the module for .glb files
#   video     the module for recordings that are videos
#   hdf5      the module for .h5 files
#   packages  what scripts/package.sh makes Debian packages with
#   docs      what scripts/docs.sh makes the API pages with
#   test      what scripts/test.sh needs: all of the above
#   lint      clang-format and clang-tidy
#   fuzz      clang with libFuzzer, for scripts/fuzz.sh
#   all       test and lint
set -euo pipefail

packages=()
# add PACKAGE ...: packages that no list has named yet.
add() {
  local package
  for package in "$@"; do
    if [[ " ${packages[*]} " != *" $package "* ]]; then packages+=("$package"); fi
  done
}
add_list() {
  case "$1" in
    fit)
      # libceres-dev depends on SuiteSparse, Eigen, glog and gflags; the runtime of OpenBLAS can be linked.
      add g++ cmake ninja-build libceres-dev libeigen3-dev libsuitesparse-dev libgoogle-glog-dev libgflags-dev \
        libopenblas0-pthread libnanoflann-dev libspectra-dev nlohmann-json3-dev zlib1g-dev
      # What the pages and pictures of results are made with; all of it goes into the programs.
      add libjs-three libstb-dev fonts-dejavu-core
      ;;
    tracking)
      add_list fit
      add libopencv-core-dev libopencv-calib3d-dev libopencv-features2d-dev libopencv-imgproc-dev \
        libopencv-imgcodecs-dev libopencv-video-dev libyaml-cpp-dev
      ;;
    demo) add_list tracking ;;
    python) add_list tracking && add python3-dev pybind11-dev python3-numpy ;;
    pcl) add_list fit && add libpcl-dev ;;
    vtk) add_list fit && add libvtk9-dev ;;
    gltf) add_list fit && add libtinygltf-dev ;;
    video) add_list tracking && add libopencv-videoio-dev ;;
    hdf5) add_list fit && add libhdf5-dev ;;
    packages) add_list python && add dpkg-dev file lintian ;;
    docs) add doxygen python3 ;;
    test)
      for list in packages pcl vtk gltf video hdf5 docs; do add_list "$list"; done
      # ITK judges displacement fields.
      add libinsighttoolkit5-dev
      add ccache make pkg-config libopenblas-dev libgtest-dev libgmock-dev python3-pytest python3-pil mypy \
        python3-build python3-pip python3-setuptools python3-venv python3-wheel chromium chromium-driver \
        python3-selenium firefox-esr xvfb
      # Engines on which cohorts are run.
      add parallel snakemake
      ;;
    lint) add clang-format clang-tidy ;;
    fuzz) add clang libclang-rt-14-dev ;;
    all) add_list test && add_list lint ;;
    *)
      echo "setup.sh: no list '$1', expected fit, tracking, demo, python, pcl, vtk, gltf, video, hdf5, packages, docs, test, lint, fuzz or all" >&2
      exit 1
      ;;
  esac
}

for list in "${@:-demo}"; do add_list "$list"; done

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
