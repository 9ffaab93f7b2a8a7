#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# hardened.sh PROGRAM: what the linker and the compiler were told can be seen in the program, or in a
# module of Python.
set -eu

# require TEXT WHAT OPTION…: what readelf prints with the options holds TEXT.
require() {
  text=$1
  what=$2
  shift 2
  readelf --wide "$@" | grep -q -- "$text" || {
    echo "not hardened: $what"
    exit 1
  }
}

require 'Type:.*DYN' "the program is not position independent" --file-header "$1"
case "$1" in
  *.so) flags='FLAGS_1.*NOW' ;;
  *) flags='FLAGS_1.*NOW.*PIE' ;;
esac
require "$flags" "its symbols are not bound at once" --dynamic "$1"
require GNU_RELRO "its relocations stay writable" --program-headers "$1"
require '_chk@' "it calls no checked functions" --dyn-syms "$1"
if readelf --wide --program-headers "$1" | grep 'GNU_STACK' | grep -q 'RWE'; then
  echo "not hardened: its stack can be executed"
  exit 1
fi
