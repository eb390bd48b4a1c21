#!/usr/bin/env bash
# Runs commands of the README on a bare Debian 12 in a folder of its own, one after the other, and prints how many
# packages each of them has installed, how large they are, and the time that it took. As root, for it uses chroot.
# test_setup.sh [--all | COMMAND ...]
# Without arguments this is the demo up to the fits; --all is the rest of the demo and the tests, too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commands=("$@")
case "${1:-}" in
  "") commands=("scripts/demo.sh --fits") ;;
  --all) commands=("scripts/demo.sh --fits" "scripts/demo.sh" "scripts/test.sh") ;;
  -*) echo "usage: test_setup.sh [--all | COMMAND ...]" >&2; exit 1 ;;
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
failed=0
read -r bare_count bare_size < <(packages)
for command in "${commands[@]}"; do
  say "$command"
  # The programs' output passes; the time is what the shell prints behind it.
  { time in_root bash -c "cd /root/ceres_ed && $command" >"$root/command.log" 2>&1; } 2>"$root/command.time" ||
    { failed=1; grep -A 30 '\*\*\*Failed' "$root/command.log" >&2 || true; tail -30 "$root/command.log" >&2; }
  grep -E -A 20 '^== mean distances|^[0-9]+ passed, ' "$root/command.log" || true
  read -r real user system < <(tail -1 "$root/command.time")
  read -r count size < <(packages)
  rows+=("$((count - bare_count)) $(awk "BEGIN { print $size - $bare_size }") $real $user $system $command")
done

say "added to $bare_count packages of $bare_size MB, on $(nproc) cores"
printf '%-24s %10s %10s %10s %10s %10s\n' command packages MB seconds user system
for row in "${rows[@]}"; do
  read -r count size real user system name <<<"$row"
  printf '%-24s %10s %10.0f %10.0f %10.0f %10.0f\n' "$name" "$count" "$size" "$real" "$user" "$system"
done
exit "$failed"
