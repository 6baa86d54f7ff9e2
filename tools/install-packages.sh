#!/bin/sh
# Installs the Debian packages that the build and the tests need; does nothing when all are there.
set -eu
packages="g++ cmake ninja-build ccache git ca-certificates
libfmt-dev libeigen3-dev libtbb-dev librandom123-dev libxsimd-dev libceres-dev libtomlplusplus-dev nlohmann-json3-dev
libcli11-dev libexpected-dev libnlopt-dev libnlopt-cxx-dev libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev
nodejs npm chromium python3 python3-ezdxf"
missing=""
for package in $packages; do
  case "$package" in
    nodejs | npm) command -v "${package%js}" >/dev/null 2>&1 && continue ;;
  esac
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "install ok installed" || missing="$missing $package"
done
[ -z "$missing" ] && exit 0
sudo=""
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null 2>&1 || { echo "install-packages: needs root or sudo to install:$missing" >&2; exit 1; }
  sudo=sudo
fi
$sudo env DEBIAN_FRONTEND=noninteractive apt-get update -q
# shellcheck disable=SC2086
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
