#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# reproducible.sh [TARGET…]: builds engine and command line, or these targets, twice, from copies of
# the sources in folders of different names, and compares the bytes of libraries and program.
set -eu
project=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -gt 0 ] || set -- episcope-cli
targets=$*
folder=$(mktemp -d "${TMPDIR:-/tmp}/reproducible.XXXXXX")
trap 'rm -rf "$folder"' EXIT

# build NAME: copies what git knows of the project to NAME, and builds it there.
build() {
  mkdir -p "$folder/$1"
  git -C "$project" ls-files -z | (cd "$project" && xargs -0 tar -cf -) | tar -xf - -C "$folder/$1"
  # Without a compiler cache, which would hand the bytes of one folder to the other, and without
  # CUDA, whose compiler makes names of the paths of its sources.
  # shellcheck disable=SC2086 # One word a target.
  (cd "$folder/$1" && cmake --preset headless -DEPISCOPE_TESTS=OFF -DEPISCOPE_BENCH=OFF \
    -DCMAKE_CXX_COMPILER_LAUNCHER= -DEPISCOPE_CCACHE= -DEPISCOPE_CUDA=OFF >/dev/null &&
    cmake --build --preset headless --target $targets >build.log) ||
    { tail -20 "$folder/$1/build.log"; exit 1; }
}

# sums NAME: of what was built there.
sums() {
  (cd "$folder/$1/build/headless" && find . -type f \( -name '*.a' -o -name episcope-cli \) | sort | xargs sha256sum)
}

build first
build a_folder_with_another_and_longer_name
sums first >"$folder/first.txt"
sums a_folder_with_another_and_longer_name >"$folder/second.txt"
cat "$folder/first.txt"
[ -s "$folder/first.txt" ]
diff "$folder/first.txt" "$folder/second.txt"
echo "reproducible.sh: both builds are the same bytes"
