#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Makes the programs: installs the Debian packages that are missing, configures and builds Release
# into build/. Steps that are done already are left out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  cat <<'USAGE'
Usage: tools/setup.sh [--tests | --test-packages] [--spy] [--no-build]
Installs missing Debian packages (and asks for root when it must), configures and builds Release
into build/; the programs are then in build/bin/.
  --tests          also build the tests, and install the packages that they need
  --test-packages  install the packages that the tests need, but do not build the tests
  --spy            also build lio-spy, and install Java
  --no-build       install the packages alone
Environment: LIO_PRESET  CMake preset that builds into build/ (release; ci when CI=true)
             LIO_JOBS    number of parallel compilers (one per core)
USAGE
}

# The packages that CMake looks for, then those that the scripts call. libpcl-dev is large, but only
# its files are used.
packages=(g++ cmake ninja-build libeigen3-dev libceres-dev libtbb-dev libboost-dev libyaml-cpp-dev
  libspdlog-dev libfmt-dev libcli11-dev nlohmann-json3-dev libsqlite3-dev liblz4-dev libbz2-dev libzstd-dev
  libpcap-dev
  libpcl-dev libembree-dev liblcm-dev liblcm-bin
  python3 python3-matplotlib iproute2 util-linux xz-utils)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev libnanoflann-dev
  clang libclang-rt-dev llvm clang-format clang-tidy chromium help2man lintian systemd
  snakemake python3-scipy
  pybind11-dev python3-dev python3-numpy python3-pip python3-setuptools python3-wheel mypy)
spy_packages=(default-jdk-headless default-jre liblcm-java libjchart2d-java)

with_tests=OFF with_spy=no target=lio_programs with_build=yes
while (($#)); do
  case $1 in
    --tests) with_tests=ON && target=all && packages+=("${test_packages[@]}") ;;
    --test-packages) with_tests=ON && packages+=("${test_packages[@]}") ;;
    --no-build) with_build=no ;;
    --spy) with_spy=yes && packages+=("${spy_packages[@]}") ;;
    -h | --help) usage && exit 0 ;;
    *) echo "tools/setup.sh: unknown argument $1; see tools/setup.sh --help" >&2 && exit 2 ;;
  esac
  shift
done

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
      echo "$package"
  done
}

install_packages() {
  local command=(apt-get -qq -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300) as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "tools/setup.sh: root is needed once; run as root:" \
        "apt-get install --no-install-recommends $*" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "setup: installing $*"
  # A third-party source that cannot be reached must not stop what Debian's own can give.
  "${as_root[@]}" "${command[@]}" update ||
    echo "setup: apt-get update failed; trying with the package lists that are there" >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "${command[@]}" install -y \
    --no-install-recommends "$@" </dev/null >/dev/null || {
    echo "tools/setup.sh: apt-get could not install the packages; see its words above" >&2
    exit 1
  }
}

if command -v dpkg-query >/dev/null; then
  mapfile -t missing < <(missing_packages)
  if ((${#missing[@]})); then install_packages "${missing[@]}"; fi
else
  echo "setup: not a Debian system; CMake will say what is missing of: ${packages[*]}" >&2
fi

[[ $with_build == yes ]] || exit 0

# Clones and work trees in other folders share their objects, if ccache is installed.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
preset=${LIO_PRESET:-$([[ ${CI:-} == true ]] && echo ci || echo release)}
jobs=${LIO_JOBS:-$(nproc)}
# Tests once asked for stay in the build folder; a plain set-up then leaves them alone.
if [[ $with_tests == ON || ! -f build/CMakeCache.txt ]]; then
  echo "setup: configuring build/ (preset $preset)"
  cmake --preset "$preset" -DLIO_BUILD_TESTS=$with_tests --log-level=NOTICE >/dev/null
elif [[ $with_spy == yes && ! -f build/share/liod/lio_types.jar ]]; then
  echo "setup: configuring build/ again, for Java"
  cmake build --log-level=NOTICE >/dev/null
fi
echo "setup: building $target with $jobs jobs"
cmake --build build --target "$target" --parallel "$jobs"
echo "setup: done; the programs are in build/bin/"
