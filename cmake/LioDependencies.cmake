# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(TBB REQUIRED)
find_package(Boost 1.74 REQUIRED) # headers alone: Boost.Math
find_package(embree 3 REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(BZip2 REQUIRED)
find_path(LZ4_INCLUDE_DIR lz4frame.h REQUIRED) # Debian's liblz4-dev has no CMake files
find_library(LZ4_LIBRARY lz4 REQUIRED)
find_path(ZSTD_INCLUDE_DIR zstd.h REQUIRED) # nor has libzstd-dev
find_library(ZSTD_LIBRARY zstd REQUIRED)
find_path(PCAP_INCLUDE_DIR pcap/pcap.h REQUIRED) # nor has libpcap-dev
find_library(PCAP_LIBRARY pcap REQUIRED)
include(FindLcm)
include(FindPclIo)
if(LIO_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(benchmark REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_path(NANOFLANN_INCLUDE_DIR nanoflann.hpp REQUIRED) # a rival in tools/bench, headers alone
  include(GoogleTest)
endif()

# The Python package is Debian's Python's, also where another one comes first on the PATH.
if(LIO_BUILD_PYTHON AND NOT LIO_SANITIZE AND NOT LIO_FUZZ)
  if(EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the package liod is for")
  endif()
  find_package(Python3 3.9 COMPONENTS Interpreter Development.Module QUIET)
  if(Python3_Development.Module_FOUND)
    find_package(pybind11 2.10 CONFIG QUIET)
  endif()
endif()
