#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# update.sh TEXTS LUPDATE SOURCES FOLDER [OPTION…]: brings all texts of the sources, and of the engine
# as the program TEXTS prints them, into the translations in FOLDER; options are those of lupdate.
set -eu
texts=$1
lupdate=$2
cd "$3"
folder=$4
shift 4
trap 'rm -f "$folder/engine_texts.h"' EXIT
"$texts" . >"$folder/engine_texts.h"
set -- "$@" -silent -I . -extensions cpp,h -locations none -source-language en
for file in "$folder"/episcope_*.ts; do
  # English needs no more than plurals.
  case "$file" in
    *_en.ts) plurals=-pluralonly ;;
    *) plurals= ;;
  esac
  # shellcheck disable=SC2086 # One word, or none.
  "$lupdate" "$@" $plurals annotation app widgets "$folder/engine_texts.h" -ts "$file"
done
