#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# full_disk.sh EPISCOPE_CLI FOLDER: where files may not grow, then on a disk that is full, then read-only, everything that
# writes says so in a sentence and leaves what was there as it was. Root only (mounts); skipped otherwise.
set -eu
cli=$1
folder=$2
if [ "${3:-}" != mounted ]; then
  if [ "$(id -u)" -ne 0 ] || ! unshare --mount --propagation private true 2>/dev/null; then
    echo "skipped: nothing can be mounted here"
    exit 77
  fi
  exec unshare --mount --propagation private sh "$0" "$cli" "$folder" mounted
fi

rm -rf "$folder"
mkdir -p "$folder/disk"
cd "$folder"
XDG_CACHE_HOME="$folder/cache"
export XDG_CACHE_HOME

# What is on the disk, but for a benchmark that was begun, whose log may be there, and empty.
contents() { (cd disk && find . -type f -size +0 | sort | xargs -r sha256sum); }

failed=""
limit=unlimited
# expect_refused WHAT SENTENCE ARGUMENTS…: fails with one sentence, and the disk is as it was.
expect_refused() {
  what=$1
  sentence=$2
  shift 2
  contents >before.txt
  code=0
  (ulimit -f "$limit" && exec "$cli" "$@" >out.txt 2>err.txt) || code=$?
  contents >after.txt
  if [ "$code" -ne 1 ] || ! grep -Eiq "$sentence" err.txt || [ "$(wc -l <err.txt)" -ne 1 ]; then
    echo "$what: exit code $code: $(cat err.txt)"
    failed="$failed $what"
  fi
  if ! cmp -s before.txt after.txt; then
    echo "$what: the disk is not as it was"
    diff before.txt after.txt || true
    failed="$failed $what"
  fi
}

# expect_all SENTENCE: of all that writes.
expect_all() {
  expect_refused result "$1" estimate epi_l lf.h5 -o disk/old.h5 -q
  expect_refused blocks "$1" estimate epi_l lf.h5 -o disk/blocks.h5 --memory 40M -q
  expect_refused scene "$1" synthesize edge -o disk/new.h5 --views 5x5 --size 96x96 --noise 20 -q
  for form in h5 npy npz mat; do
    expect_refused "convert to $form" "$1" convert lf.h5 disk/new.$form -q
  done
  expect_refused "convert to grid" "$1" convert lf.h5 disk/grid --to grid -q
  expect_refused movie "$1" show lf.h5 -o disk/movie.gif --what parallax
  expect_refused benchmark "$1" benchmark lf.h5 --methods epi_l,epi_s -o disk/tables -q
}

# Units of 512 bytes: less than the first line of a benchmark's log.
limit=1
"$cli" synthesize edge -o lf.h5 --views 5x5 --size 96x96 --noise 20 -q
"$cli" estimate epi_l lf.h5 -o disk/old.h5 --views center -q
expect_all 'larger than allowed'
limit=unlimited

if ! mount -t tmpfs -o size=256k tmpfs disk; then
  echo "skipped: nothing can be mounted here"
  exit 77
fi
trap 'umount disk' EXIT
"$cli" estimate epi_l lf.h5 -o disk/old.h5 --views center -q
head -c 300000 /dev/urandom >disk/full 2>/dev/null || true
expect_all 'no space|disk (is )?full|not enough (room|space)'
mount -o remount,ro disk
# A form that asks for room first is told that there is none.
expect_all 'read-only|disk is full'
[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
