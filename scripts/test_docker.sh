#!/usr/bin/env bash
# Builds the image of scripts/docker/Dockerfile and fits a pair in it. Where no docker answers, the two scripts of
# the Dockerfile run on bare Debians instead, as root (chroot).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

pair=data/plane_bumps
fit=(ed_fit "/$pair/source.ply" "/$pair/target.ply" --output=/fitted.ply)
python='import ceres_ed; print("Python package", ceres_ed.__version__)'
if docker info >/dev/null 2>&1; then
  docker build -f scripts/docker/Dockerfile -t ceres_ed:test .
  docker run --rm -v "$PWD/data:/data:ro" ceres_ed:test "${fit[@]}"
  docker run --rm ceres_ed:test python3 -c "$python"
  echo "the image of docker works"
  exit 0
fi

echo "no docker answers, so the scripts of the Dockerfile run on bare Debians"
packages=$(mktemp -d)
stage=${1:-build}
if [[ $stage == build ]]; then
  # The second stage is a run of this script of its own, which has a bare Debian of its own.
  # shellcheck source=scripts/bare_debian.sh
  source scripts/bare_debian.sh
  mkdir "$root/ceres_ed"
  tar --create --exclude=./build --exclude=./install --exclude=./.git . | tar --extract --directory "$root/ceres_ed"
  say "the first stage"
  in_root /ceres_ed/scripts/docker/build_packages.sh >"$root/build.log" 2>&1 ||
    { tail -30 "$root/build.log" >&2; exit 1; }
  cp "$root"/ceres_ed/build/packages/*.deb "$packages/"
  scripts/test_docker.sh "$packages"
  rm -rf "$packages"
else
  rmdir "$packages"
  # shellcheck source=scripts/bare_debian.sh
  source scripts/bare_debian.sh
  say "the second stage"
  mkdir "$root/packages" "$root/data"
  cp "$stage"/*.deb "$root/packages/"
  cp -r "$pair" "$root/data/"
  cp scripts/docker/install_packages.sh "$root/"
  # The modules that the Dockerfile adds where nobody names others.
  read -ra modules < <(sed -n 's/^ARG MODULES="\(.*\)"$/\1/p' scripts/docker/Dockerfile)
  in_root /install_packages.sh /packages "${modules[@]}" >"$root/install.log" 2>&1 || { tail -30 "$root/install.log" >&2; exit 1; }
  grep -E '^After this operation' "$root/install.log"
  in_root "${fit[@]}"
  in_root ed_fit "/$pair/source.ply" "/$pair/target.ply" --output=/fitted.glb
  in_root python3 -c "$python"
  echo "the stages of the Dockerfile work on bare Debians"
fi
