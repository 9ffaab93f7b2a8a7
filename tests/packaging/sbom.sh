#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# sbom.sh SCRIPT PROGRAM: the bill of materials names the program with its bytes, and HDF5 with the
# version that is installed and the licence of the table; the same bytes at the same time of making.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
SOURCE_DATE_EPOCH=0 "$1" "$2" >"$work/first"
SOURCE_DATE_EPOCH=0 "$1" "$2" >"$work/second"
cmp "$work/first" "$work/second"
grep -q '^Created: 1970-01-01T00:00:00Z$' "$work/first"
grep -q "^PackageChecksum: SHA256: $(sha256sum <"$2" | cut -d ' ' -f 1)\$" "$work/first"
hdf5=$(dpkg-query -S '*/libhdf5_serial.so.*' | sed -n '1s/[:,].*//p')
version=$(dpkg-query -W -f='${Version}' "$hdf5")
grep -A 6 "^PackageName: $hdf5\$" "$work/first" >"$work/hdf5"
grep -qx "PackageVersion: $version" "$work/hdf5"
grep -qx 'PackageLicenseDeclared: BSD-3-Clause-LBNL' "$work/hdf5"
# Every package has a name, an id of its own and a relation to the program.
names=$(grep -c '^PackageName: ' "$work/first")
ids=$(grep '^SPDXID: SPDXRef-' "$work/first" | sort -u | wc -l)
relations=$(grep -c '^Relationship: ' "$work/first")
[ "$names" -eq "$((ids - 1))" ] && [ "$names" -eq "$relations" ]
