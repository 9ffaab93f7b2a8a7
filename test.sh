#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# ./test.sh [--all] [--sanitize] [--packages] [--reproducible] [--fuzz SECONDS]: builds everything and runs every test; one that passed before and
# of which nothing has changed since, not a byte, is left out unless --all is given. With --sanitize
# also under AddressSanitizer, UndefinedBehaviorSanitizer and ThreadSanitizer; with --packages makes
# packages and tries them in a fresh Debian (as root); with --reproducible builds the command line
# twice and compares the bytes; with --fuzz runs each fuzzer of tests/fuzz for SECONDS.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here"
# shellcheck source=resources/packages.sh
. resources/packages.sh

failed=""

# run_preset PRESET [CACHE ENTRY…]: configures, builds, tests.
run_preset() {
  preset=$1
  shift
  echo
  echo "== $preset =="
  cmake --preset "$preset" "$@" >/dev/null || return 1
  cmake --build --preset "$preset" || return 1
  if [ -z "$all" ]; then
    export EPISCOPE_BUILD="$here/build/$preset" EPISCOPE_PASSED="$here/build/passed"
  fi
  ctest --preset "$preset" --parallel 2 --no-tests=error || return 1
}

# check_preset PRESET [CACHE ENTRY…]: notes a failure and goes on.
check_preset() {
  if ! run_preset "$@"; then
    failed="$failed $1"
  fi
}

# run_fuzzers: builds and runs them.
run_fuzzers() {
  cmake --preset fuzz >/dev/null && cmake --build --preset fuzz --target fuzzers || return 1
  tests/fuzz/run.sh build/fuzz/tests/fuzz "$fuzz"
}

# note PART COMMAND…: notes a failure of the part and goes on.
note() {
  part=$1
  shift
  echo
  echo "== $part =="
  "$@" || failed="$failed $part"
}

all=""
sanitize=""
packages=""
reproducible=""
fuzz=""
usage() {
  echo "usage: ./test.sh [--all] [--sanitize] [--packages] [--reproducible] [--fuzz SECONDS]" >&2
  exit 2
}
while [ $# -gt 0 ]; do
  case "$1" in
    --all) all=1 ;;
    --sanitize) sanitize=1 ;;
    --packages) packages=1 ;;
    --reproducible) reproducible=1 ;;
    --fuzz)
      shift
      fuzz=${1:-}
      case "$fuzz" in "" | *[!0-9]*) usage ;; esac
      ;;
    *) usage ;;
  esac
  shift
done

started=$(date +%s)
# shellcheck disable=SC2086 # One word a package.
install_missing $ENGINE_PACKAGES $WINDOW_PACKAGES $TEST_PACKAGES ${packages:+$PACKAGING_PACKAGES} \
  ${fuzz:+$FUZZ_PACKAGES}
# run.sh leaves the tests out of a build that it configures, and joins sources.
# Packages are for machines without CUDA; and one of the presets proves that all is well without.
check_preset release -DEPISCOPE_TESTS=ON -DEPISCOPE_BENCH=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_CUDA_ARCHITECTURES=80 ${packages:+-DEPISCOPE_CUDA=OFF}
note command_line env -u DISPLAY -u WAYLAND_DISPLAY ./run.sh
# What opens without Qt is configured, and with --all built and tested.
if [ -n "$all" ]; then
  check_preset headless -DEPISCOPE_TESTS=ON -DEPISCOPE_CUDA=OFF -DCMAKE_UNITY_BUILD=ON
else
  note headless cmake --preset headless -B build/configured -DEPISCOPE_CUDA=OFF
fi
if [ -n "$sanitize" ]; then
  check_preset dev
  check_preset tsan
fi
if [ -n "$packages" ]; then
  note packages cmake --build --preset release --target packages
  note fresh_debian tests/packaging/fresh_debian.sh build/release/packages
fi
if [ -n "$reproducible" ]; then
  note reproducible tests/packaging/reproducible.sh
fi
if [ -n "$fuzz" ]; then
  note fuzz run_fuzzers
fi
minutes=$((($(date +%s) - started + 59) / 60))

echo
if [ -n "$failed" ]; then
  echo "test.sh: FAILED in$failed ($minutes min)"
  exit 1
fi
echo "test.sh: everything passed ($minutes min)"
