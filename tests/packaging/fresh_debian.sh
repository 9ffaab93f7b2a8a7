#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# fresh_debian.sh FOLDER: installs the packages in FOLDER into a fresh, minimal Debian 12, uses both
# programs and the engine there, and removes them. Needs root rights, mmdebstrap and lintian.
set -eu
packages=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
project=$(cd "$here/../.." && pwd)
if [ "$(id -u)" -ne 0 ]; then
  echo "fresh_debian.sh: making a Debian needs root rights; run it as root" >&2
  exit 1
fi

echo "== lintian"
lintian --allow-root --fail-on error --tag-display-limit 0 "$packages"/*.deb

echo "== a fresh Debian"
root=$(mktemp -d "${TMPDIR:-/tmp}/fresh_debian.XXXXXX")
trap 'rm -rf --one-file-system "$root"' EXIT
chmod 755 "$root"
sources=/etc/apt/sources.list.d/debian.sources
[ -f "$sources" ] || sources=/etc/apt/sources.list
mmdebstrap --quiet --variant=minbase --include=ca-certificates bookworm "$root" "$sources"
# How this machine reaches the archive: proxies, retries.
apt-config dump --format '%f "%v";%n' | grep -E '^Acquire::(http|https|Check|Retries)' \
  >"$root/etc/apt/apt.conf.d/99host" || true
for file in /etc/resolv.conf /etc/hosts; do
  cp "$file" "$root/etc/" 2>/dev/null || true
done
mkdir "$root/media/packages"
cp "$packages"/*.deb "$root/media/packages/"
cp -r "$project/resources/packaging/example" "$root/media/example"
cp "$here/in_fresh_debian.sh" "$root/media/"

# In a mount namespace of its own: the mounts end with the command.
unshare --mount --propagation private sh -c '
  for mount in proc sys dev dev/pts; do mount --bind "/$mount" "$1/$mount"; done
  mount -t tmpfs tmpfs "$1/dev/shm"
  exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    chroot "$1" sh /media/in_fresh_debian.sh' sh "$root"
echo "fresh_debian.sh: everything passed"
