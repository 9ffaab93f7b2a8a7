#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# memcheck.sh FOLDER INPUTS [FUZZER…]: reads seeds and INPUTS mutants of them by the programs in FOLDER, or those of these
# names, under valgrind, which also sees what libraries without a sanitizer do to memory. They are built by
# `cmake -DEPISCOPE_FUZZ=ON` without EPISCOPE_SANITIZE. The first input with an error is kept in FOLDER/findings.
set -eu
folder=$1
inputs=$2
shift 2
if [ $# -eq 0 ]; then
  for program in "$folder"/*_fuzz; do
    set -- "$@" "$(basename "$program" _fuzz)"
  done
fi
# Inputs are written to memory.
if [ -z "${TMPDIR:-}" ] && [ -w /dev/shm ]; then
  TMPDIR=/dev/shm
  export TMPDIR
fi
failed=""
for name in "$@"; do
  seeds="$folder/seeds/$name"
  findings="$folder/findings/$name"
  rm -rf "$seeds"
  mkdir -p "$seeds" "$findings"
  "$folder/${name}_fuzz" "--seeds=$seeds"
  # Of what is reachable at the end nothing is told, nor of leaks: libraries keep much.
  if valgrind --quiet --error-exitcode=9 --exit-on-first-error=yes --num-callers=20 \
    "$folder/${name}_fuzz" "$inputs" "$findings/last" "$seeds"/* >"$folder/$name.log" 2>&1; then
    rm -f "$findings/last"
    echo "$name: $inputs inputs"
  else
    mv "$findings/last" "$findings/memcheck"
    echo "$name: FAILED: $(grep -m 1 '^==' "$folder/$name.log" || tail -n 1 "$folder/$name.log"); see $folder/$name.log"
    failed="$failed $name"
  fi
done
[ -z "$failed" ]
