#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Unpacks Debian's libraries for 64-bit ARM that the library and its tests link; does nothing when they are there. Needs no root, and
# leaves packages and package lists of the machine alone.
#   tools/fetch-sysroot.sh FOLDER
set -eu
folder=${1:?usage: tools/fetch-sysroot.sh FOLDER}
here=$(cd "$(dirname "$0")" && pwd)
[ ! -f "$folder/.whole" ] || exit 0

# The one list of packages, without the tools of this machine and what is left out there.
packages=$(tr ' ' '\n' <"$here/install-packages.sh" | grep -E '^(lib.*-dev|nlohmann-json3-dev|zlib1g-dev)$' | grep -v openmpi)
work=$folder.apt
rm -rf "$folder" "$work"
mkdir -p "$folder" "$work/lists/partial" "$work/cache/archives/partial"
folder=$(cd "$folder" && pwd)
work=$(cd "$work" && pwd)
: >"$work/status"
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" >"$work/sources.list"
apt() {
  apt-get -q -y -o APT::Sandbox::User=root -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Debug::NoLocking=1 \
    -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$work/lists" \
    -o Dir::State::status="$work/status" -o Dir::Cache="$work/cache" "$@" >>"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; exit 1; }
}
apt update
# shellcheck disable=SC2086  # a list of names
apt install --download-only --no-install-recommends libc6-dev libstdc++-12-dev $packages
for package in "$work"/cache/archives/*.deb; do dpkg-deb -x "$package" "$folder"; done
# Links from the root lead out of the folder.
find "$folder" -type l -lname '/*' | while read -r link; do
  target=$(readlink "$link")
  ln -sfn "$(realpath -ms --relative-to="$(dirname "$link")" "$folder$target")" "$link"
done
# shellcheck disable=SC2016  # CMake expands the variable
# pagmo's file for CMake says where the library is on a machine of that kind.
sed -i 's#"/usr/lib/#"${LINKWRIGHT_SYSROOT}/usr/lib/#' "$folder"/usr/lib/*/cmake/pagmo/*.cmake
rm -rf "$work"
touch "$folder/.whole"
