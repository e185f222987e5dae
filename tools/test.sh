#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Sets up and runs all tests: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/test.sh [--fast | --asan | --tsan] [CTEST_ARGUMENT...]
Sets up, with what only tests need, and runs all tests by ctest; then those of fuzz, io, app and
core under the address and undefined-behaviour sanitizers, and those of app under the thread
sanitizer. Tests that need the real data look for it in LIO_DATA, else in ../shared/data, and are
reported as skipped without it.
  --fast  without the sanitizers
  --asan  only the tests under the first two (build-asan/)
  --tsan  only the tests of app, under the thread sanitizer (build-tsan/)
The sanitizers build with clang++, a second compiler beside g++.
Environment: LIO_JOBS      parallel compilers and tests (one a core)
             GTEST_FILTER  which of the tests run under the sanitizers (all)
USAGE
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
part=all
case ${1:-} in
  -h | --help) usage && exit 0 ;;
  --fast | --asan | --tsan) part=${1#--} && shift ;;
esac
jobs=${LIO_JOBS:-$(nproc)}
# Objects of ccache do not depend on the folder of the tree, as in tools/setup.sh.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

# run_shards PROGRAM: its tests in shards, as many at a time as there are jobs; eight for each job,
# because one alone would often end long after the other.
run_shards() {
  local shards=$((8 * jobs)) shard failed=0
  rm -f "$1".*.log
  # shellcheck disable=SC2016  # The inner shell expands its own arguments.
  seq 0 $((shards - 1)) | GTEST_TOTAL_SHARDS=$shards GTEST_BRIEF=1 xargs -P "$jobs" -I{} sh -c \
    'GTEST_SHARD_INDEX=$2 "$1" >"$1.$2.log" 2>&1 && mv "$1.$2.log" "$1.$2.passed.log"' \
    sh "$1" {} || failed=1
  for ((shard = 0; shard < shards; shard++)); do
    [[ -f $1.$shard.passed.log ]] || cat "$1.$shard.log"
  done
  # Passed and skipped tests have a line each, "[  PASSED  ] 12 tests.".
  cat "$1".*.log | awk '/^\[ +(PASSED|SKIPPED) +\]/ && $4 + 0 {num[$2] += $4}
    END {for (kind in num) printf "test: %d %s\n", num[kind], kind}'
  return $failed
}

# sanitized PRESET TEST_PROGRAM...: builds the programs by that preset and runs all their tests. The
# scene that the daemon's tests play comes from the release build's simulator.
sanitized() {
  local build=build-$1 program failed=0 start=$SECONDS
  [[ -f $build/build.ninja ]] || cmake --preset "$1" -DLIO_BUILD_TESTS=ON \
    "-DLIO_SCENE_DIR=$PWD/build/test_data/scene" --log-level=NOTICE >/dev/null
  echo "test: building with the sanitizers of the preset $1: ${*:2}"
  cmake --build "$build" --target "${@:2}" --parallel "$jobs"
  echo "test: built in $((SECONDS - start)) s"
  ctest --test-dir build -R '^MakeScene$' --output-on-failure >/dev/null
  for program in "${@:2}"; do
    start=$SECONDS
    run_shards "$build/bin/$program" || failed=1
    echo "test: $program, preset $1: $((SECONDS - start)) s"
  done
  return $failed
}

run_asan() {
  export UBSAN_OPTIONS=print_stacktrace=1:${UBSAN_OPTIONS:-}
  sanitized asan "$@"
}

run_tsan() {
  export TSAN_OPTIONS=suppressions=$PWD/tools/tsan.supp:${TSAN_OPTIONS:-}
  sanitized tsan lio_app_test
}

if [[ $part == all || $part == fast ]]; then
  tools/setup.sh --tests
  ctest --test-dir build --output-on-failure --parallel "$jobs" "$@"
else
  tools/setup.sh --test-packages
fi
case $part in
  all)
    run_asan lio_fuzz_test lio_io_test lio_app_test lio_core_test
    run_tsan
    ;;
  asan) run_asan lio_fuzz_test lio_io_test lio_app_test lio_core_test ;;
  tsan) run_tsan ;;
esac
