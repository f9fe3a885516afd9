# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2034
# Functions and lists for the scripts of tools/; source it. Package names are those of Debian 12.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Ninja runs two jobs more than there are processors: on two, that takes up to a tenth longer.
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

build_packages=(cmake ninja-build g++ libfmt-dev libsimdjson-dev nlohmann-json3-dev libtbb-dev
  libcli11-dev libtomlplusplus-dev libmeshoptimizer-dev libdraco-dev libpng-dev libjpeg62-turbo-dev libwebp-dev libzstd-dev libopenexr-dev
  libembree-dev libxxhash-dev libsodium-dev libstb-dev fonts-dejavu-core)
test_packages=(libtinygltf-dev libavif-dev libopenimageio-dev lld clang clang-format clang-tidy libclang-rt-dev libgtest-dev libgmock-dev git python3 python3-numpy
  nodejs pre-commit curl libxml2-utils shellcheck pkg-config doxygen mandoc
  tumbler bubblewrap dbus python3-dbus libglib2.0-bin shared-mime-info)
package_packages=(libtinygltf-dev libopenimageio-dev dpkg-dev file gzip)  # for Debian packages

slurm_packages=(slurm-wlm slurm-wlm-basic-plugins munge python3)  # only for nightly
oracle_packages=(python3-jsonschema)  # only for nightly
page_packages=(chromium npm)  # large: only for nightly
target_packages=(blender chromium python3-numpy assimp-utils python3-vtk9 python3-open3d godot3-server npm)  # engines; only for nightly
web_packages=(chromium firefox-esr npm python3)
cycles_packages=(blender python3-numpy)  # the importer of glTF needs NumPy; only for nightly

say() { printf '\n== %s\n' "$*"; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Node.js from another source includes npm, which conflicts with Debian's package.
is_installed() {
  case $1 in
    npm) command -v npm >/dev/null && return 0 ;;
    nodejs) command -v node >/dev/null && return 0 ;;
  esac
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# install_packages NAME...: installs only missing packages.
install_packages() {
  local missing=() package
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ "${#missing[@]}" -gt 0 ] || return 0
  say "Installing ${missing[*]}"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q update
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends -o DPkg::Lock::Timeout=600 \
    install "${missing[@]}"
}

# build PRESET [TARGET...]: configures and builds below build/.
build() {
  local preset=$1
  shift
  (cd "$root" && cmake --preset "$preset" && cmake --build --preset "$preset" ${1:+--target "$@"})
}

# The scripts of the project.
shell_files() {
  find "$root/tools" "$root/tests" "$root/examples" "$root/.ci" -type f -exec grep -lE '^#!/bin/bash|^# shellcheck shell=bash' {} + |
    sort
}

# The C++ files of the project.
cpp_files() {
  find "$root/libgltfx" "$root/tools" "$root/tests" "$root/examples" -name '*.[ch]pp' | sort
}
