#!/usr/bin/env bash
# Tests the packages of scripts/package.sh on a bare Debian 12 in a folder of its own: it installs them there,
# runs the demo, builds and runs the example project with its plugin, and uses the Python package and the
# module for PCL. It needs root because it uses chroot.
# test_packages.sh [FOLDER (build/packages)]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=${1:-build/packages}
if ! compgen -G "$packages/*.deb" >/dev/null; then
  echo "test_packages.sh: no packages in $packages: run scripts/package.sh" >&2
  exit 1
fi

# shellcheck source=scripts/bare_debian.sh
source scripts/bare_debian.sh
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages/"
shopt -s nullglob

# install PATTERN ...: the packages whose files match.
install_packages() {
  local files=()
  # shellcheck disable=SC2206  # a pattern on purpose
  for pattern in "$@"; do files+=("$root"/packages/$pattern); done
  apt_get install --no-install-recommends "${files[@]#"$root"}" >"$root/packages/apt.log" ||
    { tail -20 "$root/packages/apt.log" >&2; return 1; }
  grep -E '^[0-9]+ upgraded|^After this' "$root/packages/apt.log"
}

say "the programs and the library they need"
apt_get update >/dev/null
install_packages 'libceres-ed[0-9]*.deb' 'ceres-ed-tools_*.deb'
in_root ed_fit --version
in_root sh -c 'cd /root && ceres_ed_demo'

say "the example project, with CMake"
cp -r apps/examples/consumer "$root/root/consumer"
install_packages 'libceres-ed-dev_*.deb'
apt_get install --no-install-recommends cmake make g++ pkg-config >/dev/null
in_root cmake -S /root/consumer -B /root/consumer/build -DCMAKE_BUILD_TYPE=Release
in_root cmake --build /root/consumer/build
in_root /root/consumer/build/consumer
say "and with pkg-config"
# shellcheck disable=SC2016  # expands in there
in_root sh -c 'g++ /root/consumer/main.cc -o /root/by_hand $(pkg-config --cflags --libs ceres_ed)'
in_root /root/by_hand
say "its plugin"
in_root ed_list_energies --plugin=/root/consumer/build/floor.so
pair=/usr/share/ceres_ed/data/plane_bumps
in_root ed_fit $pair/source.ply $pair/target.ply --output=/root/floored.ply --warp=/root/warp.json --finish=false \
  --plugin=/root/consumer/build/floor.so --energy=floor:weight=1e4,height=-0.01

say "the Python package"
install_packages 'python3-ceres-ed_*.deb'
in_root python3 -c "
import ceres_ed
source, target = (ceres_ed.load('$pair/%s.ply' % name) for name in ('source', 'target'))
print(ceres_ed.fit(source, target).status)"

say "PCD files"
printf 'FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n0 0 0\n0.01 0 0\n' >"$root/root/points.pcd"
if in_root ed_apply /root/warp.json /root/points.pcd --output=/root/moved.pcd 2>"$root/root/error"; then
  echo "test_packages.sh: a PCD file was read without ceres-ed-pcl" >&2
  exit 1
fi
cat "$root/root/error"
install_packages 'ceres-ed-pcl_*.deb'
in_root ed_apply /root/warp.json /root/points.pcd --output=/root/moved.pcd

# Each module writes a file that nothing else can, and without it one sentence names its package.
while read -r module file <&3; do
  say "files such as $file"
  output=(--output="/root/$file" "$pair/source.ply")
  if [[ $module == hdf5 ]]; then output=(--field="/root/$file"); fi
  if in_root ed_apply /root/warp.json "${output[@]}" 2>"$root/root/error"; then
    echo "test_packages.sh: $file was written without ceres-ed-$module" >&2
    exit 1
  fi
  grep "ceres-ed-$module" "$root/root/error"
  install_packages "ceres-ed-${module}_*.deb"
  in_root ed_apply /root/warp.json "${output[@]}"
done 3<<<'hdf5 field.h5
gltf moved.glb
vtk moved.vtp'

say "and gone again"
apt_get remove --purge 'libceres-ed*' 'ceres-ed-*' python3-ceres-ed >/dev/null
left=$(in_root find /usr -name '*ceres_ed*' -o -name '*ceres-ed*' -o -name 'ed_fit')
if [[ -n $left ]]; then
  echo "test_packages.sh: left behind: $left" >&2
  exit 1
fi
echo "all packages installed, worked and were removed"
