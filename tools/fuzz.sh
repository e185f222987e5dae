#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs the fuzzers of test/fuzz: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/fuzz.sh [SECONDS [TARGET...]]
Builds libFuzzer's programs by the preset fuzz (clang++, ASan and UBSan, in build-asan/) and runs
each, or the TARGETs (folders of test/fuzz/corpus), for so many SECONDS (60), as many at once as
there are jobs. It starts from test/fuzz/corpus/TARGET and from what earlier runs found, which is
kept in out/fuzz/TARGET. An input that crashes, leaks, takes 10 s or 2 GB is written to
out/fuzz/TARGET-crash-... and the script ends with 1: mend the fault, and add the input to
test/fuzz/corpus/TARGET, where a test runs it in every build.
Environment: LIO_JOBS  parallel compilers and fuzzers (one a core)
USAGE
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ ${1:-} != -h && ${1:-} != --help ]] || { usage && exit 0; }
seconds=${1:-60}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "tools/fuzz.sh: '$seconds' is no number of seconds" >&2 && exit 2; }
shift || true
jobs=${LIO_JOBS:-$(nproc)}
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
targets=("$@")
((${#targets[@]})) || mapfile -t targets < <(cd test/fuzz/corpus && ls)

# program_of event_log: lio_fuzz_EventLog
program_of() {
  local words name=""
  IFS=_ read -ra words <<<"$1"
  for word in "${words[@]}"; do name+=${word^}; done
  echo "build-asan/bin/lio_fuzz_$name"
}

fuzz_one() {
  local target=$1
  mkdir -p "out/fuzz/$target"
  if "$(program_of "$target")" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -max_len=65536 -print_final_stats=1 -verbosity=0 -artifact_prefix="out/fuzz/$target-" \
    "out/fuzz/$target" "test/fuzz/corpus/$target" >"out/fuzz/$target.log" 2>&1; then
    echo "fuzz: $target: $(awk '/number_of_executed_units/ { print $2 }' "out/fuzz/$target.log") inputs"
  else
    echo "fuzz: $target: a fault, see out/fuzz/$target.log" && return 1
  fi
}

grep -qs '^LIO_FUZZ:BOOL=ON' build-asan/CMakeCache.txt ||
  cmake --preset fuzz "-DLIO_SCENE_DIR=$PWD/build/test_data/scene" --log-level=NOTICE >/dev/null
cmake --build --preset fuzz --parallel "$jobs"
mkdir -p out/fuzz
export -f fuzz_one program_of
export seconds
printf '%s\0' "${targets[@]}" | xargs -0 -n 1 -P "$jobs" bash -euc 'fuzz_one "$1"' _ ||
  { echo "tools/fuzz.sh: faults were found; their inputs are in out/fuzz/" >&2 && exit 1; }
