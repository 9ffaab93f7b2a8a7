#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run.sh PYTHON FILE: runs the tests of a file. 77 = pytest is missing.
set -eu
if ! "$1" -c 'import pytest' 2>/dev/null; then
  echo "skipped: pytest is not installed"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PYTHONDONTWRITEBYTECODE=1 XDG_CACHE_HOME="$work/cache" \
  "$1" -m pytest -q -p no:cacheprovider --basetemp "$work/tests" "$2"
