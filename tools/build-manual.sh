#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Builds build/manual/index.html, the manual: pages that open from disk, with the workbench beside the lessons and all pictures made
# anew. It takes the program of build/release or build/ci and the page of tools/build-workbench.sh, and builds what is missing.
set -eu
cd "$(dirname "$0")/.."

if ! command -v doxygen >/dev/null 2>&1; then
  echo "The C++ reference needs doxygen: apt-get install doxygen" >&2
  exit 1
fi
program=
for preset in release ci; do
  [ -x "build/$preset/bin/linkwright" ] && program=build/$preset/bin/linkwright && break
done
if [ -z "$program" ]; then
  tools/install-packages.sh run
  cmake --preset release --log-level=WARNING
  cmake --build --preset release --target linkwright --parallel "$(tools/build-jobs.sh)"
  program=build/release/bin/linkwright
fi
[ -f build/wasm/workbench.html ] || tools/build-workbench.sh
[ -d web/node_modules/katex ] || (cd web && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
exec node web/manual/build.mjs "$program" build/manual --workbench build/wasm/workbench.html --pictures
