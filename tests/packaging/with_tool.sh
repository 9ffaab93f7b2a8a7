#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# with_tool.sh TOOL COMMAND…: runs the command; where TOOL is not installed, says that it is skipped.
tool=$1
shift
if ! command -v "$tool" >/dev/null; then
  echo "skipped: $tool is not installed"
  exit 77
fi
exec "$@"
