#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Prints how many compilers may run at once: one a processor (one more costs a tenth more of each and gains nothing), but no
# more than memory holds at 2 GB each, the most that sources compiled together take.
set -eu
jobs=$(nproc 2>/dev/null || echo 2)
available_kb=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB$/\1/p' /proc/meminfo 2>/dev/null || true)
if [ -n "$available_kb" ]; then
  fit=$((available_kb / 2000000))
  [ "$fit" -ge 1 ] || fit=1
  [ "$jobs" -le "$fit" ] || jobs=$fit
fi
echo "$jobs"
