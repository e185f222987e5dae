// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds what a pass over a drive has found of its sensors, beyond what the rig says of them. The
// next pass over the same drive begins with it, where this one had to find it on the way.
#pragma once

#include <optional>

#include "lio/base/pose.hpp"
#include "lio/filter/clock_offset.hpp"
#include "lio/imu/imu_convention.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {

struct FoundSensors {
  std::optional<ImuConvention> convention;    // the inertial messages are read by it
  std::optional<Pose> T_imu_lidar;            // absent: nothing contradicts the rig's
  std::optional<ExtrinsicStd> extrinsic_std;  // how well T_imu_lidar is known
  ClockBelief clock;  // at the first scan; to be added to rig.lidar.clock_offset_s
};

// Returns the same for an imu whose axes are those of the messages, in place of those that the rig
// makes of the lidar's: for a rig that nobody has measured.
[[nodiscard]] FoundSensors InAxesOfMessages(FoundSensors found, const Rig& rig);

// Returns the options with extrinsic and clock offset as found; the extrinsic is known as well as
// the rig's was.
[[nodiscard]] Options WithFound(Options options, const FoundSensors& found);

}  // namespace lio
