#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause

# Runs the recipes of examples/cluster as far as one machine can: cluster_recipes.sh LINKWRIGHT SOURCE
set -eu
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
export PATH
recipes=$2/examples/cluster
study=$2/examples/studies/fourbar-18-points.toml
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

numbers() { cat "$1"/seeds.csv "$1"/points.csv; }
linkwright run "$study" --out whole --quiet
numbers whole >whole.txt
sh "$recipes/loop.sh" "$study" loop 3 >loop.txt
numbers loop | cmp - whole.txt
for k in 1 2; do
  SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_ID=$k SLURM_CPUS_PER_TASK=1 bash "$recipes/slurm-array.sh" "$study" slurm
done
bash "$recipes/slurm-merge.sh" slurm >slurm.txt
numbers slurm | cmp - whole.txt
if command -v parallel >/dev/null; then
  sh "$recipes/parallel.sh" "$study" parallel 3 >parallel.txt
  numbers parallel | cmp - whole.txt
else
  sh -n "$recipes/parallel.sh"
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
if [ -e "$(dirname "$1")/../lib/linkwright/mpi.so" ] && mpirun -n 2 true 2>mpi.txt; then
  SLURM_NTASKS=2 bash "$recipes/slurm-mpi.sh" "$study" mpi 2>mpi.txt
  numbers mpi | cmp - whole.txt
else
  bash -n "$recipes/slurm-mpi.sh"
fi
echo "the recipes give the numbers of one run"
