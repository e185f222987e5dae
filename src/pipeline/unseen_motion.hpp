// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How much farther than the inertial samples say may the body have come? A match that is farther
// off than that, and than matches err, is wrong.
#pragma once

#include <vector>

#include "lio/filter/pose_event.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {

struct UnseenMotionParameters {
  // s. A missed motion, or an error that the rig made in one, is left in the estimate for so long,
  // above all in its velocity. Measured against 1 s: docs/experiments/refused_matches.md.
  double lasts_s = 3.0;
};

inline constexpr UnseenMotionParameters kUnseenMotion;

// Is one of the samples missing or saturated, so that nothing is known of the motion?
[[nodiscard]] bool IsMotionHidden(const std::vector<ImuSample>& samples);

// Gives how much errors of the rig within `bounds` add to the motion that these samples show: a
// lever arm that is wrong by l moves by l times the turn, an extrinsic that is turned by a moves by
// a times the path and turns by a times the turn, and stamps that are d off move by d times the
// speed.
[[nodiscard]] UnseenMotion MotionByRigErrors(const RigBounds& bounds,
                                             const std::vector<ImuSample>& samples,
                                             double speed_mps);

}  // namespace lio
