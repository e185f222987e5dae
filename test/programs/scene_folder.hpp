// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names the folder of the short simulated drive that the tests of whole programs share.
#pragma once

#include <string>

namespace lio::test {

inline const std::string kScene = LIO_SCENE_DIR;

}  // namespace lio::test
