#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# check_sources.sh CHECK ROOT "FOLDER …" [ALLOWED]: runs CHECK.awk, which says what it looks for, on the
# sources in these folders of ROOT.
set -eu
check=$(cd "$(dirname "$0")" && pwd)/$1.awk
cd "$2"
# shellcheck disable=SC2086 # A list of folders.
find $3 -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' | LC_ALL=C sort |
  awk -v targets="$3" -v allowed="${4:-}" -f "$check"
