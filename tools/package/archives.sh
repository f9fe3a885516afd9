# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# Builds archives of libraries from Debian's sources, for libraries without one in Debian. Source it after tools/lib.sh,
# with `folder` set to the working folder.

sources=$folder/sources
prefix=$folder/prefix

# fetch_sources LIBRARY...: downloads their sources with a separate apt configuration.
fetch_sources() {
  local apt=$folder/apt options name
  mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/parts" "$sources"
  # shellcheck disable=SC2016  # apt fills these in
  apt-get indextargets --format '$(SITE) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' | sort -u |
    awk '{ print "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]", $1, $2, $3 }' \
      >"$apt/parts/sources.list"
  options=(-q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$apt/parts"
    -o "Dir::State::lists=$apt/lists" -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update
  (cd "$sources" && apt-get "${options[@]}" source --download-only --tar-only "$@")
  for name; do
    rm -rf "${sources:?}/$name"
    mkdir "$sources/$name"
    tar -xf "$(ls "$sources/${name}"_*.orig.tar.?z)" -C "$sources/$name" --strip-components=1
  done
}

version_of() { # version_of LIBRARY: of its source
  local file
  file=$(basename "$(ls "$sources/$1"_*.orig.tar.?z)")
  file=${file#"$1"_}
  file=${file%.orig.*}
  echo "${file%%+d*}"
}

# archive LIBRARY [OPTION...]: builds it, into the prefix. `archive_flags` are those of the compiler.
archive() {
  local name=$1
  shift
  say "Building $name"
  "${configure[@]:-cmake}" -G Ninja -S "$sources/$name" -B "$folder/libraries/$name" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
    -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
    -DCMAKE_CXX_FLAGS="-ffile-prefix-map=$folder=. ${archive_flags:-}" "$@" >"$folder/$name.log"
  cmake --build "$folder/libraries/$name" -j"$(nproc)" --target install >>"$folder/$name.log"
}
