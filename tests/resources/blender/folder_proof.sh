#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# folder_proof.sh EPISCOPE_CLI WORK: what Blender renders, seen by the program, is whole, in order and
# converted without loss; what it has rendered so far can be opened.
set -eu
cli=$1
work=$2
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../../resources/blender/scenes.py
rm -rf "$work"
mkdir -p "$work/archive"

# expect TEXT PATTERN
expect() {
  if ! printf '%s\n' "$1" | grep -Eq "$2"; then
    printf 'expected %s in:\n%s\n' "$2" "$1"
    exit 1
  fi
}

"$here/run_blender.sh" "$scenes" glass --seed 1 --out "$work/glass" --grid 3x3 --size 120x100 \
  --samples 4 --threads 2 >"$work/log.txt" || {
  code=$?
  tail -3 "$work/log.txt"
  exit $code
}
folder=$("$cli" info "$work/glass")
expect "$folder" "Blender light field \(rendered by Blender"
expect "$folder" "3×3 views of 120×100 px"
expect "$folder" "order +as stored \(checked against the ground truth"
expect "$folder" "9 depth maps behind transparent surfaces"
"$cli" convert "$work/glass" "$work/archive/lf.h5" >/dev/null
archive=$("$cli" info "$work/archive/lf.h5")
expect "$archive" "order +as stored \(checked against the ground truth"
for row in "^camera" "^truth" "^layers" "^labels"; do
  of_folder=$(printf '%s\n' "$folder" | grep "$row" || true)
  of_archive=$(printf '%s\n' "$archive" | grep "$row" || true)
  if [ "$of_folder" != "$of_archive" ]; then
    printf 'the folder has:\n%s\nits conversion:\n%s\n' "$of_folder" "$of_archive"
    exit 1
  fi
done

# As if rendering had got no further than the center.
sed -i '/"complete"/,$d' "$work/glass/light_field.json"
printf ' "complete": [[1, 1]]\n}\n' >>"$work/glass/light_field.json"
expect "$("$cli" info "$work/glass")" "1 of 9 views are rendered so far; shown are the 1×1"
