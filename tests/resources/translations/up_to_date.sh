#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# up_to_date.sh LUPDATE TEXTS SOURCES: every text of the sources has a finished translation in every
# language, and no translation is of a text that is gone.
set -eu
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
translations=$3/resources/translations
cp "$translations"/*.ts "$copy"
sh "$translations/update.sh" "$2" "$1" "$3" "$copy"
status=0
for file in "$copy"/episcope_*.ts; do
  # The source is on the line before its translation.
  if grep -B 1 'type="' "$file" | grep -E '<source>|type="'; then
    echo "$(basename "$file"): unfinished, or no longer in the sources"
    status=1
  fi
done
[ $status -eq 0 ] || echo "Build the target update_translations, and translate (resources/manual/pages/adding.md)."
exit $status
