#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Validates a library of assets as a job array, one part a task:
#   parts=$(sbatch --parsable --array=1-16 validate-library.sh LIBRARY RESULTS)
#   sbatch --dependency=afterany:"$parts" --wrap 'gltfx merge RESULTS/*.jsonl --fail-on error'
# A task that was killed runs again with the same command; the cache keeps what it has done.
# `merge` names the parts that are missing, and exits with the verdict on all assets.
#SBATCH --job-name=gltfx
#SBATCH --cpus-per-task=2
#SBATCH --mem=2G
#SBATCH --time=01:00:00
set -euo pipefail
library=$1 results=$2
mkdir -p "$results"
exec gltfx validate "$library" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --cache "$results/cache" \
  --fail-on never \
  --format jsonl="$results/$SLURM_ARRAY_TASK_ID.jsonl"
