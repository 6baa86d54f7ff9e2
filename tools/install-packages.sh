#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Installs the Debian packages that are missing; does nothing, quickly, when all are there.
#   tools/install-packages.sh run    what the program needs to be built
#   tools/install-packages.sh test   that, and what the tests, the benchmarks and the workbench need
set -eu

packages="g++ cmake ninja-build ccache
libfmt-dev libeigen3-dev libtbb-dev librandom123-dev libxsimd-dev libtomlplusplus-dev
nlohmann-json3-dev libcli11-dev libexpected-dev libsundials-dev libnlopt-dev libnlopt-cxx-dev
libpagmo-dev libboost1.74-dev zlib1g-dev pkgconf
nodejs npm"
case "${1:-}" in
  run) ;;
  test) packages="$packages
git clang-format doxygen flake8 shellcheck yamllint libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev chromium python3 python3-ezdxf python3-jsonschema emscripten
pybind11-dev python3-dev python3-numpy python3-pandas python3-pip python3-venv binutils
dpkg-dev patchelf xz-utils zstd debootstrap libopenmpi-dev openmpi-bin" ;;
  *) echo "usage: tools/install-packages.sh run|test" >&2; exit 2 ;;
esac

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
  # shellcheck disable=SC2086  # on one line
  {
    echo "This machine has no apt-get, so nothing is installed; the build goes on with what is there."
    echo "These are the packages of Debian 12 that it needs:" $packages
  } >&2
  exit 0
fi

# One call for all packages: lines "<name> installed" for those that are there.
# shellcheck disable=SC2086  # a list of names
there=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $packages 2>/dev/null || true)
missing=""
for package in $packages; do
  # A node or npm from elsewhere serves as well, and Debian's would clash with it.
  case "$package" in
    nodejs) command -v node >/dev/null 2>&1 && continue ;;
    npm) command -v npm >/dev/null 2>&1 && continue ;;
  esac
  case "
$there
" in
    *"
$package installed
"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=""
elif command -v sudo >/dev/null 2>&1; then
  as_root="sudo"
else
  echo "These packages are missing, and installing them needs root or sudo:$missing" >&2
  exit 1
fi

apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" >/dev/null
}
echo "Installing (a few minutes on a bare machine):$missing"
if ! apt update; then
  echo "The package lists could not be fetched (is the network up?); trying with the old ones." >&2
fi
# shellcheck disable=SC2086  # a list of names
if ! apt install --no-install-recommends $missing; then
  echo "apt-get could not install:$missing" >&2
  echo "The messages above say why; without a network, install them by other means and start again." >&2
  exit 1
fi
