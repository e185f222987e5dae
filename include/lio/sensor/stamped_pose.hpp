// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A pose in time, as trajectories consist of.
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
