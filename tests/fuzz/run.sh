#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run.sh FOLDER SECONDS [FUZZER…]: runs the fuzzers in FOLDER, or those of these names, for SECONDS each, beginning with files that
# each writes itself. What was found to lead further is kept in FOLDER/corpus for the next time; inputs that fail are
# in FOLDER/findings; how many inputs all runs of a fuzzer had is in FOLDER/executions. Fails if there are findings.
set -eu
folder=$1
seconds=$2
shift 2
if [ $# -eq 0 ]; then
  for program in "$folder"/*_fuzz; do
    set -- "$@" "$(basename "$program" _fuzz)"
  done
fi
here=$(cd "$(dirname "$0")" && pwd)
# Leaks are looked for at the end: after every input takes too long.
LSAN_OPTIONS="suppressions=$here/../../resources/sanitizers/fuzz.supp:print_suppressions=0"
export LSAN_OPTIONS
# Freed memory is kept back for a while, but not so much that every input takes new pages; where it was taken is told
# when an input that failed is run again, alone. HDF5 asks for impossible amounts of memory in damaged files, and can do
# without.
ASAN_OPTIONS="quarantine_size_mb=8:malloc_context_size=0:allocator_may_return_null=1"
export ASAN_OPTIONS
# Inputs are written to memory.
if [ -z "${TMPDIR:-}" ] && [ -w /dev/shm ]; then
  TMPDIR=/dev/shm
  export TMPDIR
fi
# How rare what an input reaches is, which "entropic" counts, takes up to a third of the time.
options="-entropic=0 -len_control=0 -rss_limit_mb=2560 -malloc_limit_mb=1024 -timeout=30 -detect_leaks=0 -print_funcs=0"
# length_of NAME: texts are short, and arrays of a few views take little more than their headers.
length_of() {
  case "$1" in
    capture | config | excerpt | manifest | mesh | names | poses | project) echo 4096 ;;
    labels | map | numpy | picture | result | strokes | weights) echo 8192 ;;
    *) echo 16384 ;;
  esac
}

# count LOG NAME: adds the inputs of a run to those of the fuzzer, and prints both.
count() {
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$1" | tail -n 1)
  # A run that failed says only how far it had come.
  [ -n "$inputs" ] || inputs=$(sed -n 's/^#\([0-9]*\)[^0-9].*/\1/p' "$1" | tail -n 1)
  total=$(($(cat "$folder/executions/$2" 2>/dev/null || echo 0) + ${inputs:-0}))
  echo "$total" >"$folder/executions/$2"
  echo "${inputs:-0} inputs, $total in all runs"
}

mkdir -p "$folder/executions"
failed=""
for name in "$@"; do
  corpus="$folder/corpus/$name"
  findings="$folder/findings/$name"
  log="$folder/$name.log"
  mkdir -p "$corpus" "$findings"
  "$folder/${name}_fuzz" "--seeds=$corpus"
  # shellcheck disable=SC2086 # One word an option.
  if "$folder/${name}_fuzz" $options -max_total_time="$seconds" -print_final_stats=1 \
    -max_len="$(length_of "$name")" -artifact_prefix="$findings/" "$corpus" >"$log" 2>&1; then
    echo "$name: $(count "$log" "$name")"
  else
    echo "$name: FAILED: $(grep -m 1 -E 'ERROR|runtime error|SUMMARY' "$log" || tail -n 1 "$log"); $(count "$log" "$name"); see $log"
    failed="$failed $name"
  fi
done
[ -z "$failed" ]
