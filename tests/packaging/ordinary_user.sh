#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# ordinary_user.sh EPISCOPE_CLI [EPISCOPE]: both work as a user without rights, display or D-Bus, and with a home that
# cannot be written. As root, that user is nobody.
set -eu
folder=$(mktemp -d "${TMPDIR:-/tmp}/ordinary_user.XXXXXX")
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
chmod 755 "$folder"
mkdir -m 555 "$folder/home"
mkdir -m 777 "$folder/work"
# From where anybody may run them.
for program in "$@"; do cp "$program" "$folder"; done
cli="$folder/episcope-cli"
window="$folder/episcope"
cd "$folder/work"

as_user() {
  if [ "$(id -u)" -eq 0 ]; then
    set -- setpriv --reuid=65534 --regid=65534 --clear-groups "$@"
  fi
  env -i PATH=/usr/bin:/bin HOME="$folder/home" LANG=C.UTF-8 "$@"
}

as_user sh -c "! touch '$folder/home/file' 2>/dev/null" || { echo "the home can be written"; exit 1; }
as_user "$cli" --version >/dev/null
as_user "$cli" synthesize edge -o lf.h5 --views 5x5 --size 96x96 -q
as_user "$cli" estimate epi_s lf.h5 -o r.h5 -q
as_user "$cli" evaluate r.h5 --truth lf.h5 >/dev/null
as_user "$cli" show r.h5 --what disparity -o r.png
as_user "$cli" list . >/dev/null
# What does not fit into memory cannot go to the cache.
as_user "$cli" estimate epi_g lf.h5 -o c.h5 --memory 3M -q
[ -s c.h5 ]

if [ $# -gt 1 ]; then
  # Without a display it says what to do,
  code=0
  as_user "$window" lf.h5 2>err.txt || code=$?
  if [ "$code" -ne 1 ] || ! grep -q '^episcope: there is no display' err.txt; then
    echo "without a display the window ended with $code:"
    cat err.txt
    exit 1
  fi
  # and with one that nobody sees it stays open until it is told to end.
  code=0
  as_user env QT_QPA_PLATFORM=offscreen timeout 15 "$window" lf.h5 2>err.txt || code=$?
  [ "$code" -eq 124 ] || { echo "the window ended by itself, with $code:"; cat err.txt; exit 1; }
fi
[ -z "$(ls -A "$folder/home")" ] || { echo "something was written to the home"; exit 1; }
