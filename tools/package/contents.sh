# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# Contents of linked programs: a list in SPDX format, and the licences. Source it after archives.sh.

# The licence of each component: a source of archives.sh, or a package of Debian.
declare -A licences=([fmtlib]=MIT [simdjson]=Apache-2.0 [meshoptimizer]=MIT [draco]=Apache-2.0
  [imath]=BSD-3-Clause [openexr]=BSD-3-Clause [embree]=Apache-2.0 [libc6-dev]=LGPL-2.1-or-later
  [libstdc++-12-dev]="GPL-3.0-or-later WITH GCC-exception-3.1" [libdraco-dev]=Apache-2.0
  [libjpeg62-turbo-dev]="IJG AND BSD-3-Clause" [libpng-dev]=libpng-2.0 [libsodium-dev]=ISC
  [libwebp-dev]=BSD-3-Clause [libzstd-dev]="BSD-3-Clause OR GPL-2.0-only" [libxxhash-dev]=BSD-2-Clause
  [zlib1g-dev]=Zlib [nlohmann-json3-dev]=MIT
  [libcli11-dev]=BSD-3-Clause [libtomlplusplus-dev]=MIT [libstb-dev]="MIT OR Unlicense"
  [libfast-float-dev]="Apache-2.0 OR MIT" [fonts-dejavu-core]=Bitstream-Vera
  [emscripten]="(MIT OR NCSA) AND MIT AND Apache-2.0 WITH LLVM-exception")

component_version() {
  if [ -d "$sources/$1" ]; then version_of "$1"; else dpkg-query -W -f '${Version}' "$1"; fi
}

# spdx_list SYSTEM VERSION COMPONENT...: tag-value form of SPDX 2.3, of the date in SOURCE_DATE_EPOCH.
spdx_list() {
  local system=$1 version=$2 name found
  shift 2
  cat <<EOF
SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: gltfx-$version
DocumentNamespace: urn:gltfx:$version:$system
Creator: Tool: gltfx
Created: $(date -u -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%dT%H:%M:%SZ)
EOF
  spdx_package gltfx "$version" Apache-2.0 NOASSERTION
  echo "Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-gltfx"
  for name; do
    found=$(component_version "$name")
    spdx_package "$name" "$found" "${licences[$name]}" "pkg:deb/debian/${name//+/%2B}@${found//+/%2B}"
    echo "Relationship: SPDXRef-gltfx STATIC_LINK SPDXRef-${name//+/-}"
  done
}

spdx_package() { # spdx_package NAME VERSION LICENCE LOCATION
  printf '\nPackageName: %s\nSPDXID: SPDXRef-%s\nPackageVersion: %s\n' "$1" "${1//+/-}" "$2"
  printf 'PackageDownloadLocation: NOASSERTION\nFilesAnalyzed: false\nPackageLicenseConcluded: %s\n' "$3"
  printf 'PackageLicenseDeclared: %s\nPackageCopyrightText: NOASSERTION\n' "$3"
  [ "$4" = NOASSERTION ] || printf 'ExternalRef: PACKAGE-MANAGER purl %s\n' "$4"
}

# The licences in a source, or Debian's copyright file of a package; for emscripten, those of the parts in a module.
component_copyright() {
  if [ -d "$sources/$1" ]; then
    find "$sources/$1" -maxdepth 1 -type f \( -iname 'license*' -o -iname 'third-party*' -o -iname authors \) |
      LC_ALL=C sort | xargs cat
  elif [ "$1" = emscripten ]; then
    awk -v RS= '!/^Files:/ || /\n (\*|system\/|src\/)/ { print $0 "\n" }' "/usr/share/doc/$1/copyright"
  else
    cat "/usr/share/doc/$1/copyright"
  fi
}

# notices COMPONENT...: the licence of each, then the texts that they refer to.
notices() {
  local name texts
  cat <<'EOF'
gltfx is under the Apache License 2.0. It contains the components below. What stands with each is its own licence, or
Debian's copyright file of it, which covers the whole component, also files that are not in gltfx. The C library is under the LGPL: the sources of
gltfx and tools/dist link the programs anew, with another version of it.
EOF
  for name; do
    printf '\n\n%s\n%s %s: %s\n\n' "$(printf '=%.0s' {1..80})" "$name" "$(component_version "$name")" "${licences[$name]}"
    component_copyright "$name"
  done
  texts=$(for name; do component_copyright "$name"; done |
    grep -oE '/usr/share/common-licenses/[A-Za-z0-9.+-]*[A-Za-z0-9]' | sort -u)
  for name in $texts; do
    [ -e "$name" ] || continue
    printf '\n\n%s\n%s\n\n' "$(printf '=%.0s' {1..80})" "${name##*/}"
    cat "$name"
  done
}

release_date() { # seconds since 1970, by the changelog of the Debian package
  date -u -d "$(sed -n 's/^ -- .*>  //p' "$root/tools/package/changelog" | head -n 1)" +%s
}
