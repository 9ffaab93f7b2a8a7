#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# without_display.sh WINDOW: what the window's program prints needs no display, home or D-Bus.
set -eu
version=$(env -i "$1" --version)
echo "$version" | head -n 1 | grep -Eqx 'episcope [0-9]+\.[0-9]+\.[0-9]+'
echo "$version" | grep -q '^commit '
echo "$version" | grep -q '^Qt '
echo "$version" | grep -q '^VTK '
env -i "$1" --help | grep -q INPUT
