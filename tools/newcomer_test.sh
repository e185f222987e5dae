#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Follows docs/newcomer.md on a bare Debian with recordings that liod was never told of: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/newcomer_test.sh [--suite NAME] [--keep] RECORDING...
Makes a bare Debian by debootstrap, clones the last commit of this repository into it, runs
tools/demo.sh there, which installs and builds what it needs, and then gives it each RECORDING, one
file of any kind that lio-run takes. Prints how long each step takes; a recording must have its
report.html within a minute, and no file is edited.
Needs root, debootstrap, git and 6 GB in /var/tmp; without them it says so and ends with 77.
  --suite NAME  release of Debian (that of this machine)
  --keep        leave the folder of the bare system, and say which it is
USAGE
}

suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-stable}") keep=no recordings=()
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --suite) suite=$2 && shift ;;
    --keep) keep=yes ;;
    -*) echo "tools/newcomer_test.sh: unknown argument $1; see --help" >&2 && exit 2 ;;
    *) recordings+=("$(realpath -e -- "$1")") ;;
  esac
  shift
done
((${#recordings[@]})) ||
  { echo "tools/newcomer_test.sh: name a recording; see --help" >&2 && exit 2; }
cd "$(dirname "${BASH_SOURCE[0]}")/.."

test_name=newcomer
source tools/package_test/bare_system.sh
command -v git >/dev/null || skip "there is no git here"
make_bare_system "$suite"
git clone -q . "$root/root/liod"
in_liod() { in_root bash -c 'cd /root/liod && exec "$@"' bash "$@"; }

start=$SECONDS
echo "newcomer: tools/demo.sh, with all that it installs and builds"
in_liod tools/demo.sh >"$folder/demo.log" 2>&1 || { tail -n 20 "$folder/demo.log" >&2 && exit 1; }
grep 'position error (APE' "$folder/demo.log"
echo "newcomer: the demo has ended after $((SECONDS - start)) s"

failed=0
for recording in "${recordings[@]}"; do
  cp "$recording" "$root/root/"
  rm -f "$root/root/liod/out/demo/report.html" # may be the run before's
  start=$SECONDS code=0
  in_liod tools/demo.sh "/root/$(basename "$recording")" >"$folder/demo.log" 2>&1 || code=$?
  spent_s=$((SECONDS - start))
  grep -E '^trust:|^ +[a-z_]+:|position error' "$folder/demo.log" || true
  echo "newcomer: $(basename "$recording"): exit code $code, $spent_s s to the report"
  # 6 says that the result cannot be trusted, which may be right without a rig.
  if [[ ! -s $root/root/liod/out/demo/report.html ]] ||
    ((spent_s > 60 || (code != 0 && code != 6))); then
    cat "$folder/demo.log" >&2
    failed=1
  fi
done
exit $failed
