#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Tells Snakemake how a job of Slurm is: status.sh NUMBER prints running, success or failed. A
# controller that does not answer tells nothing about the job, so it counts as running. A job that
# Slurm has forgotten counts as failed, and Snakemake submits it anew.
set -uo pipefail

state_of() { # NUMBER
  local said state
  if said=$(scontrol -o show job "$1" 2>&1); then
    sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p' <<<"$said"
  elif [[ $said == *"Invalid job id"* ]]; then
    state=$(sacct -n -X -P -o State -j "$1" 2>/dev/null | head -n 1)
    echo "${state:-FORGOTTEN}"
  else
    echo UNREACHABLE
  fi
}

case $(state_of "${1%%;*}") in
  COMPLETED) echo success ;;
  BOOT_FAIL | CANCELLED* | DEADLINE | FAILED | FORGOTTEN | NODE_FAIL | OUT_OF_MEMORY | TIMEOUT)
    echo failed
    ;;
  *) echo running ;;
esac
