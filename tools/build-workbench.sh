#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Builds build/wasm/workbench.html, the workbench in one page, with Debian's emscripten.
set -eu
cd "$(dirname "$0")/.."

for tool in em++ zstd; do
  if ! command -v "$tool" >/dev/null 2>&1; then
    echo "The workbench needs $tool: tools/install-packages.sh test installs it." >&2
    exit 1
  fi
done
# emscripten keeps the libraries of C and C++ that it has compiled; not everybody may write where Debian has put them.
cache=/usr/share/emscripten/cache
[ -w "$cache" ] || export EM_CACHE="$PWD/build/emscripten-cache"
cmake --preset wasm --log-level=WARNING
cmake --build --preset wasm --target workbench --parallel "$(tools/build-jobs.sh)"
