#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# zsh_pages.sh PAGES FOLDER: what zsh completes, asked through a terminal of its own.
set -eu
"$1" "$2"
zsh -n "$2/zsh/_episcope-cli"
exec zsh -f -s "$2/zsh" <<'SCRIPT'
zmodload zsh/zpty
folder=$1
# answer LINE: what the terminal shows after the line and a tab.
answer() {
  zpty -b shell zsh -f -i
  zpty -w shell "PS1=; fpath=($folder \$fpath); autoload -U compinit; compinit -u -d $folder/dump"
  zpty -w -n shell "$1"$'\t'
  local shown='' piece=''
  repeat 60; do
    if zpty -r -t shell piece; then shown+=$piece; fi
    [[ $shown == *"$2"* ]] && break
    sleep 0.25
  done
  zpty -d shell
  [[ $shown == *"$2"* ]] || { print "after '$1' there is no '$2': $shown"; exit 1 }
}
answer 'episcope-cli esti' 'episcope-cli estimate'
answer 'episcope-cli estimate epi_l lf.h5 --inner' '--inner-scale'
answer 'episcope-cli label lf.h5 --scr' '--scribbles'
answer 'episcope-cli estimate epi_l lf.h5 --views ce' '--views center'
SCRIPT
