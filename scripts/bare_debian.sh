# shellcheck shell=bash
# For scripts that prove something on a bare Debian 12. Sourced, it makes one by debootstrap in the new folder
# $root, which is removed when the script ends, and defines
#   in_root COMMAND ...   runs a command in there, without this machine's environment
#   apt_get OPTION ...    runs its apt-get
# CERES_ED_DEBIAN_MIRROR names another mirror than deb.debian.org.

mirror=${CERES_ED_DEBIAN_MIRROR:-http://deb.debian.org/debian}
if [[ $EUID -ne 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "$(basename "$0"): needs root and debootstrap (apt-get install debootstrap)" >&2
  exit 1
fi

say() { printf '\n== %s\n' "$*"; }

root=$(mktemp -d)
mounted=()
remove_root() {
  for folder in "${mounted[@]}"; do umount "$folder"; done
  rm -rf --one-file-system "$root"
}
trap remove_root EXIT

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
cp /etc/resolv.conf "$root/etc/resolv.conf"
for settings in /etc/apt/apt.conf.d/*proxy*; do
  if [[ -f $settings ]]; then cp "$settings" "$root/etc/apt/apt.conf.d/"; fi
done
