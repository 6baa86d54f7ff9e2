# SPDX-License-Identifier: BSD-3-Clause

# shellcheck shell=sh
# pkg_config.sh FOLDER COMPILER SOURCE PROGRAM PACKAGE: builds an example by what pkg-config says of the installed package, and runs it.
PKG_CONFIG_PATH=$1
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # flags
"$2" -O1 "$3" -o "$4" $(pkg-config --cflags --libs "$5")
"$4"
