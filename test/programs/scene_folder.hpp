// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names the folder of the short simulated drive that the tests of whole programs share.
#pragma once

#include <string>

#include "support/build_paths.hpp"

namespace lio::test {

inline const std::string kScene = SceneDir();

}  // namespace lio::test
