#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# dependencies.sh RESOURCES: every package that the project installs has a row in dependencies.md.
set -eu
# shellcheck source=resources/packages.sh
. "$1/packages.sh"
for package in $ENGINE_PACKAGES $WINDOW_PACKAGES $WAYLAND_PACKAGES $TEST_PACKAGES \
  $MANUAL_PACKAGES $FUZZ_PACKAGES $PACKAGING_PACKAGES; do
  grep -q "^| $package |" "$1/dependencies.md" || {
    echo "dependencies.md has no row of $package"
    exit 1
  }
done
