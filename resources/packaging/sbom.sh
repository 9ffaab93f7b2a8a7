#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# sbom.sh PROGRAM: the bill of materials of a built program, or of the built module of Python, as an SPDX 2.3 document in the form of
# tags and values, on standard output. Which libraries the program loads is asked of the linker, their
# packages and versions of dpkg, their licences of resources/dependencies.md. SOURCE_DATE_EPOCH, if
# set, is the time of making.
set -eu
if [ $# -ne 1 ] || [ ! -x "$1" ]; then
  echo "usage: sbom.sh PROGRAM" >&2
  exit 2
fi
program=$1
table=$(cd "$(dirname "$0")/.." && pwd)/dependencies.md
name=$(basename "$program")
case "$program" in
  *.so)
    version=$(PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$(dirname "$program")/.. \
      /usr/bin/python3 -c 'import episcope; print(episcope.__version__)')
    ;;
  *) version=$("$program" --version | sed -n '1s/.* //p') ;;
esac
checksum=$(sha256sum <"$program" | cut -d ' ' -f 1)
created=$(date -u -d "@${SOURCE_DATE_EPOCH:-$(date +%s)}" +%Y-%m-%dT%H:%M:%SZ)

# licence_of SOURCE: of the row whose package comes from the same source package.
rows=$(sed -n 's/^| \([a-z][^ |]*\) |[^|]*|[^|]*| \([^ |]*\) |.*/\1 \2/p' "$table")
# shellcheck disable=SC2046 # One word a package.
licences=$(dpkg-query -W -f='${Package} ${source:Package}\n' $(echo "$rows" | cut -d ' ' -f 1) 2>/dev/null |
  while read -r package source; do echo "$source $(echo "$rows" | sed -n "s,^$package ,,p")"; done)
licence_of() {
  found=$(echo "$licences" | sed -n "s,^$1 ,,p" | head -n 1)
  echo "${found:-NOASSERTION}"
}

cat <<HEAD
SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: $name-$version
DocumentNamespace: urn:episcope:spdx:$name:$checksum
Creator: Tool: episcope-sbom
Created: $created

PackageName: $name
SPDXID: SPDXRef-Program
PackageVersion: $version
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: false
PackageChecksum: SHA256: $checksum
PackageLicenseConcluded: NOASSERTION
PackageLicenseDeclared: BSD-3-Clause
PackageCopyrightText: Copyright (c) 2026, the Episcope authors
Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-Program
HEAD

libraries=$(ldd "$program" | sed -n 's/.* => \(\/[^ ]*\) .*/\1/p' | xargs readlink -f)
# dpkg may know a library below / that the linker finds below /usr.
# shellcheck disable=SC2086,SC2046 # One word a file.
owners=$(dpkg-query -S $libraries $(echo "$libraries" | sed 's,^/usr,,') 2>/dev/null || true)
for library in $libraries; do
  case "$owners" in
    *"${library#/usr}"*) ;;
    *)
      echo "sbom.sh: $library belongs to no package" >&2
      exit 1
      ;;
  esac
done
# shellcheck disable=SC2046 # One word a package.
dpkg-query -W -f='${Package} ${Version} ${source:Package} ${Architecture}\n' \
  $(echo "$owners" | cut -d ' ' -f 1 | sed 's/:$//' | sort -u) |
  while read -r package version source architecture; do
    id=SPDXRef-$(echo "$package" | tr -c 'A-Za-z0-9.\n-' -)
    cat <<PACKAGE

PackageName: $package
SPDXID: $id
PackageVersion: $version
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: false
PackageLicenseConcluded: NOASSERTION
PackageLicenseDeclared: $(licence_of "$source")
PackageCopyrightText: NOASSERTION
ExternalRef: PACKAGE-MANAGER purl pkg:deb/debian/$package@$version?arch=$architecture
Relationship: SPDXRef-Program DYNAMIC_LINK $id
PACKAGE
  done
