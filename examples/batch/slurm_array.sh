#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A batch as a Slurm array job, a shard for each task. After a failure, or an end of time, submit it again: it goes on.
#   sbatch --array=0-15 --export=ALL,PLAN=plan.json,OUT=/shared/out slurm_array.sh
# and, when all tasks are done: incise batch plan.json -o /shared/out --merge
#SBATCH --job-name=incise
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --requeue
set -eu
exec incise -q batch "$PLAN" -o "$OUT" --threads "${SLURM_CPUS_PER_TASK:-1}"
