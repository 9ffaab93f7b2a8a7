#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run_blender.sh SCRIPT ARGUMENTS…: runs a script in Blender without a window; exit code 77, which
# CTest takes as skipped, where Blender is not installed.
set -eu
if ! command -v blender >/dev/null; then
  echo "skipped: Blender is not installed (apt-get install --no-install-recommends blender)"
  exit 77
fi
script=$1
shift
exec blender -b --factory-startup -noaudio --python-exit-code 1 -P "$script" -- "$@"
