#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# file_types.sh FOLDER: the file types there make a database, and every type that the menu entry and
# the thumbnailer name is one of it or of the desktop's own.
set -eu
data=$(mktemp -d)
trap 'rm -rf "$data"' EXIT
types="$data/mime"
mkdir -p "$types/packages"
cp "$1/episcope.xml" "$types/packages/"
XDG_DATA_DIRS="$data" update-mime-database "$types" 2>"$data/warnings"
if [ -s "$data/warnings" ]; then
  cat "$data/warnings"
  exit 1
fi
for type in $(sed -n 's/^MimeType=//p' "$1/episcope.desktop" "$1/episcope.thumbnailer" | tr ';' ' '); do
  case "$type" in inode/*) continue ;; esac
  [ -f "$types/$type.xml" ] || { echo "$type is not described in episcope.xml"; exit 1; }
done
grep -q '^80:application/x-light-field:lf.h5$' "$types/globs2"
