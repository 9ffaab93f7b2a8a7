#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# examples.sh CLI WORK PAGE…: runs every command of the pages in a folder with the files that they
# name: lines of blocks that begin with episcope-cli, perhaps after a $, and such code in sentences
# unless a word in capitals stands for a name. 77 = a tool is missing.
set -eu
cli=$1
work=$2
shift 2
if ! command -v jq >/dev/null; then
  echo "skipped: jq is not installed"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work/bin" "$work/prepared/scene"
ln -s "$cli" "$work/bin/episcope-cli"
# Stands for a program of the reader's.
printf '#!/bin/sh\ncat >/dev/null\n' >"$work/bin/other-program"
chmod +x "$work/bin/other-program"
PATH="$work/bin:$PATH" XDG_CACHE_HOME="$work/cache"
export PATH XDG_CACHE_HOME

cd "$work/prepared"
episcope-cli synthesize objects -o scene/lf.h5 --views 3x3 --size 64x64 --quiet >prepared.log
episcope-cli estimate epi_l scene -o result.h5 --views center --quiet >>prepared.log
for name in mine.npy theirs.npy; do
  episcope-cli convert result.h5 "$name" --quiet >>prepared.log
done

# commands_of PAGE: one a line.
commands_of() {
  awk '/^```/ { inside = !inside; next }
       inside && /^(\$ )?episcope-cli / { sub(/^\$ /, ""); print }
       !inside { while (match($0, /`episcope-cli [^`]*`/)) {
                   command = substr($0, RSTART + 1, RLENGTH - 2)
                   $0 = substr($0, RSTART + RLENGTH)
                   if (command !~ /(^| )[A-Z]+( |$)/) print command } }' "$1"
}

problems=0
for page in "$@"; do
  folder=$work/$(basename "$page" .md)
  cp -r "$work/prepared" "$folder"
  cd "$folder"
  commands_of "$page" >commands
  if ! [ -s commands ]; then
    echo "$page has no command" >&2
    problems=1
  fi
  while read -r command; do
    # A failure of any part of a pipe counts.
    if ! bash -o pipefail -c "$command" </dev/null >out 2>err; then
      printf '%s: this command fails: %s\n' "$page" "$command" >&2
      cat err >&2
      problems=1
    fi
  done <commands
done
exit $problems
