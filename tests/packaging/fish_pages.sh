#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# fish_pages.sh PAGES FOLDER: what fish completes.
set -eu
"$1" "$2"
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT

# expect COMPLETION FOLDER LINE: it is among what the line is completed to.
expect() {
  HOME="$home" fish --no-config -c "source $2/fish/episcope-cli.fish; complete -C '$3'" | cut -f 1 |
    grep -qx -- "$1" || { echo "$3: no $1"; exit 1; }
}
expect estimate "$2" 'episcope-cli esti'
expect epi_l "$2" 'episcope-cli estimate epi_'
expect --inner-scale "$2" 'episcope-cli estimate epi_l lf.h5 --inner'
expect --scribbles "$2" 'episcope-cli label lf.h5 --scr'
expect center "$2" 'episcope-cli estimate epi_l lf.h5 --views '
