#!/usr/bin/env bash
# Does what the README says first, scripts/demo.sh, on a bare Debian 12 in a folder of its own, and prints how
# many packages were installed, how large they are, and the time that it took: up to the fits, and with
# --all to the end of the demo, too. As root, for it uses chroot.
# test_setup.sh [--all]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
parts=(--fits)
case "${1:-}" in
  "") ;;
  --all) parts+=("") ;;
  *) echo "usage: test_setup.sh [--all]" >&2; exit 1 ;;
esac
# shellcheck source=scripts/bare_debian.sh
source scripts/bare_debian.sh

mkdir "$root/root/ceres_ed"
tar --create --exclude=./build --exclude=./install --exclude=./.git . | tar --extract --directory "$root/root/ceres_ed"

# packages: the number of packages that are installed in there, and their size in MB (of 1000000 bytes).
packages() {
  # shellcheck disable=SC2016  # a field of dpkg's
  in_root dpkg-query --show --showformat='${Installed-Size}\n' | awk '{ sum += $1 } END { print NR, sum * 1024 / 1e6 }'
}

TIMEFORMAT="%R %U %S"
rows=()
read -r bare_count bare_size < <(packages)
for part in "${parts[@]}"; do
  say "scripts/demo.sh $part"
  # The programs' output passes; the time is what the shell prints behind it.
  { time in_root bash -c 'cd /root/ceres_ed && scripts/demo.sh "$@"' demo ${part:+"$part"} >"$root/demo.log" 2>&1; } \
    2>"$root/demo.time" || { tail -30 "$root/demo.log" >&2; exit 1; }
  if [[ -z $part ]]; then grep -A 20 '^== mean distances' "$root/demo.log"; fi
  read -r real user system < <(tail -1 "$root/demo.time")
  read -r count size < <(packages)
  rows+=("$((count - bare_count)) $(awk "BEGIN { print $size - $bare_size }") $real $user $system demo.sh $part")
done

say "added to $bare_count packages of $bare_size MB, on $(nproc) cores"
printf '%-18s %10s %10s %10s %10s %10s\n' command packages MB seconds user system
for row in "${rows[@]}"; do
  read -r count size real user system name <<<"$row"
  printf '%-18s %10s %10.0f %10.0f %10.0f %10.0f\n' "$name" "$count" "$size" "$real" "$user" "$system"
done
