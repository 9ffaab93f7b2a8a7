#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run_test.sh NAME INPUT… -- COMMAND…: runs a test. If EPISCOPE_PASSED names a folder, a test that
# passed before is not run again while its command, its inputs (programs and scripts) and the
# variables that tests look at are the same, byte by byte; EPISCOPE_BUILD, the build's folder, may be
# another one: what the headless build makes is mostly what the other one made.
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
  state=$(printf '%s\n' "$inputs" "${EPISCOPE_ISA:-}" "${EPISCOPE_SHARED_DATA:-}" "$@" |
    sed "s,${EPISCOPE_BUILD:-no build},,g" | sha256sum | cut -c 1-32)
  stamp="$EPISCOPE_PASSED/$name.$state"
  if [ -f "$stamp" ]; then
    echo "$name passed before, and nothing has changed since"
    exit 0
  fi
  "$@"
  mkdir -p "$EPISCOPE_PASSED"
  touch "$stamp"
else
  while [ "$1" != -- ]; do shift; done
  shift
  exec "$@"
fi
