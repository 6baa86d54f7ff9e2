#!/bin/sh
# A study in parts with nothing but a shell: all parts at once, then the result.
#   loop.sh study.toml out 4
set -eu
study=$1
out=$2
parts=$3
running=
for k in $(seq "$parts"); do
  linkwright run "$study" --shard "$k/$parts" --out "$out" --threads 1 --resume --quiet &
  running="$running $!"
done
for process in $running; do wait "$process"; done
exec linkwright merge "$out"
