#!/bin/bash
# A study on the ranks of one job: pieces are handed out as ranks get free, and rank 0 writes the result. Where the job was
# stopped, the same command continues from there.
#   sbatch slurm-mpi.sh study.toml out
#SBATCH --job-name=linkwright
#SBATCH --ntasks=64
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
#SBATCH --signal=B:INT@60
set -eu
mpirun -n "${SLURM_NTASKS:-1}" linkwright run "$1" --out "$2" --resume --quiet &
# A warning that time is nearly up ends the run with its best so far.
trap 'kill -INT $!' INT
while kill -0 $! 2>/dev/null; do wait $! && code=0 || code=$?; done
exit "$code"
