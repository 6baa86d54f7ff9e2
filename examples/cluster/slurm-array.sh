#!/bin/bash
# A study in 64 parts on a cluster with Slurm; where a part was stopped, the same command continues from there.
#   sbatch slurm-array.sh study.toml out
#   sbatch --dependency=afterok:JOB slurm-merge.sh out
#SBATCH --job-name=linkwright
#SBATCH --array=1-64
#SBATCH --cpus-per-task=2
#SBATCH --time=01:00:00
#SBATCH --signal=INT@60
set -eu
study=$1
out=$2
parts=${SLURM_ARRAY_TASK_COUNT:-64}
exec linkwright run "$study" --shard "$SLURM_ARRAY_TASK_ID/$parts" --out "$out" --threads "${SLURM_CPUS_PER_TASK:-1}" --resume --quiet
