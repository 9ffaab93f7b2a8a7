#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run_test.sh NAME INPUT… -- COMMAND…: runs a test. If EPISCOPE_PASSED names a folder, a test that
# passed before is not run again while its command, its inputs (programs and scripts) and the
# variables that tests look at are the same, byte by byte.
set -eu
name=$1
shift
inputs=""
if [ -n "${EPISCOPE_PASSED:-}" ]; then
  while [ "$1" != -- ]; do
    inputs="$inputs $(sha256sum <"$1")"
    shift
  done
  shift
  state=$(printf '%s\n' "$inputs" "${EPISCOPE_ISA:-}" "${EPISCOPE_SHARED_DATA:-}" "$@" | sha256sum)
  stamp="$EPISCOPE_PASSED/$name"
  if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$state" ]; then
    echo "$name passed before, and nothing has changed since"
    exit 0
  fi
  rm -f "$stamp"
  "$@"
  mkdir -p "$EPISCOPE_PASSED"
  printf '%s\n' "$state" >"$stamp"
else
  while [ "$1" != -- ]; do shift; done
  shift
  exec "$@"
fi
