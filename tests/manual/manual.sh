#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# manual.sh MANUAL CLI OUT: makes the manual and checks that it is whole: every method and verb has its
# section, every link and picture of a page exists. 77 = a tool is missing.
set -eu
manual=$1
cli=$2
out=$3
problems=0
complain() {
  echo "$1" >&2
  problems=1
}
cd "$manual/pages"
for page in *.md; do
  for target in $(sed -n 's/.*](\([^)#:]*\)[^):]*).*/\1/p' "$page"); do
    [ -e "$target" ] || complain "$page names $target, which does not exist"
  done
  grep -q ": $page\$" ../mkdocs.yml || complain "mkdocs.yml does not list $page"
done
for picture in pictures/*; do
  grep -q "$picture" ./*.md || complain "no page shows $picture"
done
for id in $("$cli" methods --json | sed -n 's/^      "id": "\(.*\)",/\1/p'); do
  grep -q "\`$id\`" methods.md || complain "methods.md lacks $id"
done
[ $problems -eq 0 ] || exit 1

for tool in mkdocs python3; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: $tool is not installed"
    exit 77
  fi
done
rm -rf "$out"
"$manual/build" "$cli" "$out"
for id in $("$cli" methods --json | sed -n 's/^      "id": "\(.*\)",/\1/p'); do
  grep -q "<code>$id</code>" "$out/reference.html" || complain "reference.html lacks $id"
done
for verb in info estimate label benchmark rectify; do
  grep -q "<h3 id=\"$verb\">" "$out/reference.html" || complain "reference.html lacks $verb"
done
exit $problems
