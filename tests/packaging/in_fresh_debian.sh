#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What fresh_debian.sh runs inside: in order of what it installs, so that no package rests on what only
# another one brings.
set -eu
export DEBIAN_FRONTEND=noninteractive
cd /media

install() {
  echo "== install $*"
  apt-get install -qq -y --no-install-recommends "$@" >/tmp/apt.log 2>&1 ||
    { tail -20 /tmp/apt.log; exit 1; }
}

# as_user COMMAND…: in a home of its own, without a display, D-Bus or rights.
as_user() {
  setpriv --reuid=nobody --regid=nogroup --clear-groups \
    env -i PATH=/usr/bin:/bin HOME=/home/user LANG=C.UTF-8 "$@"
}

# require_png FILE: it begins as a PNG does.
require_png() {
  [ "$(head -c 4 "$1" | od -An -tx1 | tr -d ' ')" = 89504e47 ] || { echo "$1 is no PNG"; exit 1; }
}

mkdir -p /home/user
chown nobody /home/user
cd /home/user
apt-get update -qq

install /media/packages/python3-episcope_*.deb
as_user python3 -c '
import episcope
lf = episcope.demo("edge?size=64&grid=5")
episcope.estimate(lf, "net")  # finds its weights
result = episcope.estimate(lf, "epi_s")
result.save("python.h5")
print(result, lf.views.shape, episcope.score(result, lf)["mse_100"])'
apt-get purge -qq -y --autoremove python3-episcope >/tmp/apt.log 2>&1
[ ! -e /usr/lib/python3/dist-packages/episcope ]

install /media/packages/episcope-cli_*.deb
as_user episcope-cli --version
as_user episcope-cli estimate epi_s demo -o d.h5 --quiet
as_user episcope-cli evaluate d.h5 --truth demo
as_user episcope-cli synthesize objects -o lf.h5 --views 5x5 --size 96x96
[ -s /usr/share/man/man1/episcope-cli-estimate.1.gz ]
[ -s /usr/share/episcope/blender/episcope_light_field.py ]
as_user episcope-cli methods net | grep -q 'SHA-256.* /usr/share/episcope/weights/net.npz'

install /media/packages/episcope_*.deb
as_user episcope --version
as_user episcope --help >/dev/null
as_user episcope-thumbnailer 64 lf.h5 thumbnail.png
require_png thumbnail.png
install xvfb xauth shared-mime-info desktop-file-utils
grep -q x-light-field /usr/share/mime/globs2
grep -q episcope.desktop /usr/share/applications/mimeinfo.cache
# The window stays open until it is told to end.
code=0
as_user xvfb-run -a -s "-screen 0 1280x800x24" timeout 20 episcope lf.h5 || code=$?
[ "$code" -eq 124 ] || { echo "the window ended by itself, with $code"; exit 1; }

install /media/packages/libepiscope-dev_*.deb g++ cmake make
cmake -S /media/example -B /tmp/example -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build /tmp/example
as_user /tmp/example/example lf.h5 example.h5
as_user episcope-cli evaluate example.h5 --truth lf.h5

echo "== remove"
apt-get purge -qq -y episcope episcope-cli libepiscope-dev >/tmp/apt.log 2>&1
rm -rf /tmp/example
left=$(find / -xdev -iname '*episcope*' -not -path '/home/*' -not -path '/media/*' \
  -not -path '/proc/*' -not -path '/var/log/*')
left="$left$(grep -rl episcope /etc /usr/share/mime /usr/share/applications /usr/share/icons \
  /var/lib/dpkg/status 2>/dev/null || true)"
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
