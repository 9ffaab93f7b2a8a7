#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# manual.sh MANUAL BINARIES OUT: makes the manual and looks whether it is whole: every method with its
# formula, parameters and picture, every verb, every picture that a page shows. 77 = a tool lacks.
set -eu
manual=$1
binaries=$2
out=$3
for tool in mkdocs xvfb-run python3; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: $tool is not installed"
    exit 77
  fi
done
rm -rf "$out"
"$manual/build" "$binaries" "$out"

problems=0
complain() {
  echo "$1" >&2
  problems=1
}
for id in $("$binaries/app/cli/episcope-cli" methods --json | sed -n 's/^      "id": "\(.*\)",/\1/p'); do
  grep -q "<code>$id</code>" "$out/methods.html" || complain "methods.html lacks $id"
  [ -s "$out/pictures/$id.png" ] || complain "there is no picture of $id"
done
for verb in info estimate label benchmark rectify; do
  grep -q "<h2 id=\"$verb\">" "$out/commands.html" || complain "commands.html lacks $verb"
done
for page in index compare paint ground_truth forms methods commands; do
  for picture in $(sed -n 's/.*src="\(pictures[^"]*\)".*/\1/p' "$out/$page.html"); do
    [ -s "$out/$picture" ] || complain "$page.html shows $picture, which is not there"
  done
done
exit $problems
