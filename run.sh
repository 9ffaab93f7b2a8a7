#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# ./run.sh [FILE]: builds Episcope and opens FILE, or the demo. Without a display it estimates the
# disparity on the command line and writes result and pictures to out/.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=resources/packages.sh
. "$here/resources/packages.sh"

usage() {
  echo "usage: ./run.sh [FILE]"
  echo "FILE is a light field: an lf.h5, a scene folder, a folder of images, demo or demo:SCENE."
}

# build PRESET TARGET…: configures what is not configured yet, and builds. Several sources are compiled
# as one (unity build), which takes half the time and suits those who build once.
build() {
  preset=$1
  shift
  if [ ! -f "$here/build/$preset/build.ninja" ]; then
    (cd "$here" && cmake --preset "$preset" -DEPISCOPE_TESTS=OFF -DEPISCOPE_BENCH=OFF \
      -DCMAKE_UNITY_BUILD=ON >/dev/null)
  fi
  cmake --build "$here/build/$preset" --target "$@"
}

run_window() {
  packages="$ENGINE_PACKAGES $WINDOW_PACKAGES"
  [ -n "${DISPLAY:-}" ] || packages="$packages $WAYLAND_PACKAGES"
  # shellcheck disable=SC2086 # One word a package.
  install_missing $packages
  build release episcope episcope-cli
  exec "$here/build/release/app/gui/episcope" "$@"
}

run_command_line() {
  input=${1:-demo}
  echo "No display: working on the command line."
  # shellcheck disable=SC2086 # One word a package.
  install_missing $ENGINE_PACKAGES
  # A build with the window has the command line, too.
  preset=headless
  [ ! -f "$here/build/release/build.ninja" ] || preset=release
  build $preset episcope-cli
  cli="$here/build/$preset/app/cli/episcope-cli"
  name=$(basename "$input" | tr -c 'A-Za-z0-9._\n-' '_')
  out="$here/out/$name"
  mkdir -p "$out"

  "$cli" info "$input"
  "$cli" estimate epi_l "$input" -o "$out/epi_l.h5" --overwrite
  "$cli" show "$input" -o "$out/view.png" --overwrite --what view
  "$cli" show "$input" -o "$out/epi.png" --overwrite --what epi
  "$cli" show "$out/epi_l.h5" -o "$out/disparity.png" --overwrite --what disparity
  if "$cli" evaluate "$out/epi_l.h5" --truth "$input" 2>"$out/evaluate.txt"; then
    "$cli" show "$out/epi_l.h5" --truth "$input" -o "$out/error.png" --overwrite --what error
  else
    echo "No error map: $(tail -n 1 "$out/evaluate.txt")"
  fi
  rm -f "$out/evaluate.txt"

  echo
  echo "The result and its pictures are in $out:"
  ls "$out"
}

case "${1:-}" in
  -h | --help)
    usage
    exit 0
    ;;
esac
if [ $# -gt 1 ]; then
  usage >&2
  exit 2
fi
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  run_window "$@"
else
  run_command_line "$@"
fi
