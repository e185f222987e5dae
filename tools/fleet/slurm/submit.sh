#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Submits a job of Snakemake to Slurm and prints its number: submit.sh RULE THREADS MEM_MB SCRIPT
# A job whose node is lost goes back into the queue.
set -euo pipefail
mkdir -p slurm
# shellcheck disable=SC2086 # FLEET_SBATCH holds words
exec sbatch --parsable --requeue --job-name "fleet-$1" --ntasks 1 --cpus-per-task "$2" \
  --mem "$3" --output "slurm/%j.txt" --open-mode append ${FLEET_SBATCH:-} "$4"
