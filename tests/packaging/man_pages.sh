#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# man_pages.sh PAGES FOLDER: man sets every page without a warning, and a value is in what it sets.
set -eu
"$1" "$2"
for page in "$2"/man/*.1; do
  warnings=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l "$page" 2>&1 >"$page.txt")
  if [ -n "$warnings" ]; then
    echo "$page: $warnings"
    exit 1
  fi
done
grep -q -- '--inner-scale' "$2/man/episcope-cli-estimate.1.txt"
