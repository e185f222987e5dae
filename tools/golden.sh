#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Checks that the estimator still gives the same bytes: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/golden.sh [--update] [--list] [--jobs N] [CASE...]
Replays short logs of every scenario, sensor and fault, and compares hashes of the results with
those in test/golden/hashes.tsv: a change that is meant to leave the estimate alone must leave them
alone. Needs what tools/fleet.sh needs: the logs are drives of a fleet in out/golden, and made once.
The recorded ones come from LIO_DATA or else ../shared/data; without them their cases are left out,
with a message.
  --update   record the new hashes; the diff of hashes.tsv shows which logs a change touches
  --list     print the cases and their commands
  --jobs N   number of cases at a time (one per core)
  CASE       run only these cases
Exit codes: 0 the same, 1 something differs, 2 usage, 3 nothing was compared, 4 snakemake or scipy
is missing. The mathematics library and the ray caster give other last bits on other processors: a
case whose simulated log differs is not compared.
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
exec /usr/bin/python3 -B tools/golden/golden.py "$@"
