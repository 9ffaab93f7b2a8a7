#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# changing_file.sh EPISCOPE_CLI SAME_RESULTS FOLDER: what becomes of a run whose light field changes on disk while
# it is open: a file that is removed, replaced or grows changes nothing, one that is cut short is told.
set -eu
cli=$1
same=$2
folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
XDG_CACHE_HOME="$folder/cache"
export XDG_CACHE_HOME

fail() {
  echo "$1"
  cat err.txt
  exit 1
}

"$cli" synthesize edge -o whole.h5 --views 5x6 --size 300x290 -q

# Samples stay in their file, since there is so little memory.
# while_open NAME COMMAND…: runs the command as soon as the first blocks are done; sets code.
while_open() {
  name=$1
  shift
  rm -rf "$name"
  mkdir "$name"
  cp whole.h5 "$name/lf.h5"
  "$cli" estimate epi_l "$name/lf.h5" -o "$name/at_once.h5" -q
  "$cli" estimate epi_l "$name/lf.h5" -o "$name/r.h5" --memory 16M --threads 1 -q 2>err.txt &
  run=$!
  until [ "$({ wc -l <"$name/r.h5.partial.log" || echo 0; } 2>/dev/null)" -ge 3 ]; do
    kill -0 $run 2>/dev/null || fail "$name: the run was done before the file was changed"
    sleep 0.01
  done
  (cd "$name" && "$@")
  code=0
  wait $run || code=$?
}

# expect_same NAME: the run ended well, with the maps of the run at once.
expect_same() {
  [ "$code" -eq 0 ] || fail "$1: exit code $code"
  "$same" "$1/at_once.h5" "$1/r.h5" 5 6 || fail "$1: other maps"
}

grow() { head -c 1000000 /dev/zero >>lf.h5; }
replace() { head -c 5000 /dev/zero >other.h5 && mv other.h5 lf.h5; }

while_open removed rm lf.h5
expect_same removed
while_open replaced replace
expect_same replaced
while_open grown grow
expect_same grown

while_open cut truncate -s 5000 lf.h5
[ "$code" -eq 1 ] || fail "cut: exit code $code"
grep -q '^episcope-cli: .*the file was truncated' err.txt || fail "cut: no sentence about it"
[ "$(wc -l <err.txt)" -eq 1 ] || fail "cut: more than a sentence"
[ ! -e cut/r.h5 ] || fail "cut: a result was written"
