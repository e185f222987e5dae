#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Does the estimator still give the same bytes? See usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/golden.sh [--update] [--list] [--jobs N] [CASE...]
Replays short logs of every scenario, sensor and fault, and compares hashes of the results with those
in test/golden/hashes.tsv: a change that is meant to leave the estimate alone must leave them alone.
Needs tools/setup.sh. The logs are simulated once, into out/golden/logs; the real ones come from
LIO_DATA, else ../shared/data, and are left out, saying so, without it.
  --update   record today's hashes; the diff of hashes.tsv shows which logs a change touches
  --list     print the cases and their commands
  --jobs N   cases at a time (one a core)
  CASE       only these
Exit codes: 0 the same, 1 something differs, 2 usage. The mathematics library and the ray caster give
other last bits on other processors: where a simulated log differs, its case is not compared.
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
exec /usr/bin/python3 -B tools/golden/golden.py "$@"
