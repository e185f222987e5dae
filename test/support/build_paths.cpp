// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/build_paths.hpp"

namespace lio::test {

std::string SourceDir() {
  return LIO_SOURCE_DIR;
}
std::string BinDir() {
  return LIO_BIN_DIR;
}
std::string TestDataDir() {
  return LIO_TEST_DATA_DIR;
}
std::string SceneDir() {
  return LIO_SCENE_DIR;
}

}  // namespace lio::test
