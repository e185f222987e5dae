// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A pose that registration is to find.
#pragma once

#include "lio/base/pose.hpp"

namespace lio::test {

inline const Pose kLoamTruth{ExpSo3(Vector3(0.05, -0.1, 0.3)), Vector3(0.5, -0.8, 0.2)};

}  // namespace lio::test
