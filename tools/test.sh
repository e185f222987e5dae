#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Sets up and runs all tests: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/test.sh [--fast] [CTEST_ARGUMENT...]
Sets up, with what only tests need, and runs all tests: first the fuzz tests under the address and
undefined-behaviour sanitizers, then everything by ctest. Tests that need the real data look for it
in LIO_DATA, else in ../shared/data, and are reported as skipped without it.
  --fast  without the sanitizers
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

with_sanitizers=yes
if [[ ${1:-} == --fast ]]; then
  with_sanitizers=no
  shift
fi
jobs=${LIO_JOBS:-$(nproc)}
tools/setup.sh --tests
if [[ $with_sanitizers == yes ]]; then
  echo "test: fuzz tests under ASan and UBSan"
  [[ -f build-asan/CMakeCache.txt ]] || cmake --preset asan --log-level=NOTICE >/dev/null
  cmake --build build-asan --target lio_fuzz_test --parallel "$jobs"
  build-asan/bin/lio_fuzz_test --gtest_brief=1
fi
ctest --test-dir build --output-on-failure --parallel "$jobs" "$@"
