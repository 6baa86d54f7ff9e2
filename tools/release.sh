#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Makes a release: every test from a clean checkout, then build/release-files with the packages, the workbench, the manual and their
# sums. It takes a commit without changes beside it, and an hour or so.
#   tools/release.sh [--ubuntu]    also uses the archive in an Ubuntu 22.04 and an Ubuntu 24.04
set -eu
cd "$(dirname "$0")/.."

if [ -n "$(git status --porcelain)" ]; then
  echo "There are changes that are not committed; a release is made of a commit." >&2
  exit 1
fi
out=$PWD/build/release-files
clean=$PWD/build/release-checkout
rm -rf "$clean" "$out"
git clone -q . "$clean"
cd "$clean"
./test
tools/build-manual.sh
python3 -B tools/package.py build/ci "$out"
if [ "${1:-}" = --ubuntu ]; then
  for suite in jammy noble; do
    python3 -B tests/packages/packages_test.py build/ci "build/packages-$suite" "$suite" http://archive.ubuntu.com/ubuntu
  done
fi
manual=linkwright-manual-$(sed -n 's/.*LINKWRIGHT_VERSION "\(.*\)"/\1/p' src/linkwright/version.h).tar.xz
tar -C build --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" -cJf "$out/$manual" manual
cp examples/container/Containerfile "$out"
cd "$out"
rm SHA256SUMS
sha256sum -- * >SHA256SUMS
cat SHA256SUMS
