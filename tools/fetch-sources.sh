#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Unpacks Debian's source packages of the libraries that a build for WebAssembly compiles itself; does nothing when they are
# there. Needs no root, and leaves the package lists of the machine alone.
#   tools/fetch-sources.sh FOLDER
set -eu
folder=${1:?usage: tools/fetch-sources.sh FOLDER}
names="sundials nlopt zlib"
missing=""
for name in $names; do [ -f "$folder/$name/.whole" ] || missing="$missing $name"; done
[ -n "$missing" ] || exit 0

mkdir -p "$folder"
cd "$folder"
rm -rf apt
mkdir -p apt/lists/partial apt/cache/archives/partial
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" >apt/sources.list
apt() {
  apt-get -q -o APT::Sandbox::User=root -o Dir::Etc::SourceList="$PWD/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$PWD/apt/lists" -o Dir::Cache="$PWD/apt/cache" "$@"
}
apt update >apt/log 2>&1 || { cat apt/log >&2; exit 1; }
for name in $missing; do
  # apt checks signature and sum of what it fetches.
  apt source --download-only "$name" >>apt/log 2>&1 || { cat apt/log >&2; exit 1; }
  rm -rf "$name"
  mkdir "$name"
  tar xf "$name"_*.orig.tar.* -C "$name" --strip-components=1
  rm -f "$name"_*
  touch "$name/.whole"
done
rm -rf apt
