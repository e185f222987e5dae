#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs many drives by many configurations: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/fleet.sh FLEET [OPTIONS]
Runs every configuration over every drive of FLEET, a YAML or TSV file, scores all runs, and leaves
one table and one page that compares them with a baseline, other systems' trajectories included.
Needs tools/setup.sh, and Debian's packages snakemake and python3-scipy.
  --out DIR      write into this folder (out/fleet/NAME, where NAME is FLEET's without its ending)
  --jobs N       number of cores to use, or with --profile of jobs at a time (all cores)
  --profile DIR  run the jobs elsewhere, by this Snakemake profile; tools/fleet/slurm is for Slurm
  --check        only validate FLEET; all faults are told with file and line
  --dry-run      tell how many jobs would run, and run none
DIR then has index.html, table.tsv, table.json, and runs/CONFIGURATION/DRIVE/ with the files of
lio-run, report.html among them. The same command continues a fleet that was stopped or killed, and
does only what changed: drives, configurations, files that they name, programs.

A FLEET for a start, 5 seeds of a simulated drive by 2 methods:
  drives:
    - {name: street, sim: --scenario street --duration 30 --lidar vlp16, seeds: 1..5}
  configurations:
    - {name: ndt}
    - {name: loam, set: pipeline.method=loam}
  baseline: ndt
docs/fleet.md has all keys, recordings and other systems among them.
Examples:
  tools/fleet.sh my_fleet.yaml
  tools/fleet.sh my_fleet.yaml --check
  tools/fleet.sh drives.tsv --out out/night --jobs 8
  tools/fleet.sh my_fleet.yaml --profile tools/fleet/slurm --jobs 200
Environment: LIO_BUILD  build folder with the programs (build)
Exit codes: 0 every run has its row, which may say that it failed, 1 runs are unfinished, 2 usage,
3 faults in FLEET, 4 snakemake or scipy is missing.
USAGE
}

case ${1:-} in
  -h | --help) usage && exit 0 ;;
  '') echo "tools/fleet.sh: name a FLEET; see tools/fleet.sh --help" >&2 && exit 2 ;;
esac
if ! /usr/bin/python3 -c 'import scipy, yaml' 2>/dev/null; then
  echo "tools/fleet.sh: scipy or yaml is missing; install Debian's packages:" \
    "apt-get install python3-scipy python3-yaml" >&2
  exit 4
fi
exec /usr/bin/python3 -B "$(dirname "${BASH_SOURCE[0]}")/fleet/fleet.py" "$@"
