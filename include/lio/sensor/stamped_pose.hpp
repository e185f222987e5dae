// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a pose with its stamp: the element of trajectories.
#pragma once

#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

struct StampedPose {
  Timestamp stamp;
  Pose pose;
};

using StampedPoses = std::vector<StampedPose>;  // stamps strictly increasing

}  // namespace lio
