#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Prints the seconds of two builds of one bench program, run in turn, best of several, and their
# ratio: ratio.sh OTHER/epi_bench build/release/tests/bench/epi_bench 'epi_l/auto:0' [ROUNDS]
set -eu
before=$1 now=$2 filter=$3 rounds=${4:-3}

# Real time of each bench that the filter selects: name,milliseconds
run() {
  "$1" --benchmark_filter="$filter" --benchmark_format=csv 2>/dev/null |
    awk -F, -v who="$2" 'header && NF > 3 { print who "," $1 "," $3 } /^name,/ { header = 1 }'
}

for round in $(seq "$rounds"); do
  run "$before" before
  run "$now" now
done | awk -F, '
  { key = $1 SUBSEP $2; if (!(key in best) || $3 < best[key]) best[key] = $3; names[$2] = 1 }
  END {
    for (name in names) {
      b = best["before" SUBSEP name]; n = best["now" SUBSEP name]
      if (b > 0 && n > 0) printf "%s: before %.0f ms, now %.0f ms, ratio %.2f\n", name, b, n, n / b
    }
  }'
