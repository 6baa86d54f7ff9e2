#!/bin/bash
# The result of the parts, when all of them have ended.
#SBATCH --job-name=linkwright-merge
#SBATCH --time=00:30:00
set -eu
exec linkwright merge "$1"
