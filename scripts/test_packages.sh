#!/usr/bin/env bash
# Tests the packages of scripts/package.sh on a bare Debian 12 in a folder of its own: it installs them there,
# runs the demo, and builds and runs the example project with its plugin. It needs root because it uses chroot.
# test_packages.sh [FOLDER (build/packages)]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=${1:-build/packages}
mirror=${CERES_ED_DEBIAN_MIRROR:-http://deb.debian.org/debian}
if [[ $EUID -ne 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "test_packages.sh: needs root and debootstrap (apt-get install debootstrap)" >&2
  exit 1
fi
if ! compgen -G "$packages/*.deb" >/dev/null; then
  echo "test_packages.sh: no packages in $packages: run scripts/package.sh" >&2
  exit 1
fi

say() { printf '\n== %s\n' "$*"; }

root=$(mktemp -d)
mounted=()
clean_up() {
  for folder in "${mounted[@]}"; do umount "$folder"; done
  rm -rf --one-file-system "$root"
}
trap clean_up EXIT

say "a bare Debian 12"
chmod 755 "$root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
  { tail -5 "$root.log" >&2; exit 1; }
rm "$root.log"
# Some installation scripts want /proc; most do without.
if mount -t proc proc "$root/proc" 2>/dev/null; then mounted+=("$root/proc"); fi
in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive "$@"; }
apt_get() { in_root apt-get -q -y -o Dpkg::Use-Pty=0 "$@"; }
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages/"
cp /etc/resolv.conf "$root/etc/resolv.conf"
shopt -s nullglob
for settings in /etc/apt/apt.conf.d/*proxy*; do cp "$settings" "$root/etc/apt/apt.conf.d/"; done

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
in_root ed_fit $pair/source.ply $pair/target.ply --output=/root/floored.ply --finish=false \
  --plugin=/root/consumer/build/floor.so --energy=floor:weight=1e4,height=-0.01

say "and gone again"
apt_get remove --purge 'libceres-ed*' ceres-ed-tools >/dev/null
left=$(in_root find /usr -name '*ceres_ed*' -o -name '*ceres-ed*' -o -name 'ed_fit')
if [[ -n $left ]]; then
  echo "test_packages.sh: left behind: $left" >&2
  exit 1
fi
echo "all packages installed, worked and were removed"
