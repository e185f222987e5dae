// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names the folders that a test finds its files in. They stand in one object file, so that the
// other objects are the same in every clone and ccache finds them again.
#pragma once

#include <string>

namespace lio::test {

std::string SourceDir();    // the source tree
std::string BinDir();       // the programs of this build
std::string TestDataDir();  // the shared data, unpacked once per build folder
std::string SceneDir();     // a short simulated drive that the tests of whole programs share

// The path of the named program of this build, such as "lio-eval".
inline std::string Program(const std::string& name) {
  return BinDir() + "/" + name;
}

}  // namespace lio::test
