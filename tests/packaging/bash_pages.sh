#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# bash_pages.sh PAGES FOLDER: what bash completes.
set -eu
"$1" "$2"
exec bash -s "$2/bash/episcope-cli" <<'SCRIPT'
source "$1"
# expect COMPLETION WORD…: the last word is completed to exactly this.
expect() {
  local expected=$1
  shift
  COMP_WORDS=(episcope-cli "$@")
  COMP_CWORD=$#
  _episcope_cli
  [[ ${COMPREPLY[*]} == "$expected" ]] || { echo "$*: ${COMPREPLY[*]}, not $expected"; exit 1; }
}
expect estimate esti
expect "epi_l" estimate epi_l
expect --inner-scale estimate epi_l lf.h5 --inner
expect "" estimate kz02 lf.h5 --inner
expect "center" estimate epi_l lf.h5 --views ce
expect "" estimate epi_l lf.h5 -o ./b
expect --scribbles label lf.h5 --scr
expect "cpu" estimate epi_l lf.h5 --device cp
SCRIPT
