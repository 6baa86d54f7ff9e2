#!/bin/sh
# A study in parts on the machines that GNU parallel knows (here: this one), one part a processor.
#   parallel.sh study.toml out 16
set -eu
study=$1
out=$2
parts=$3
seq "$parts" | parallel --halt soon,fail=1 linkwright run "$study" --shard "{}/$parts" --out "$out" --threads 1 --resume --quiet
exec linkwright merge "$out"
