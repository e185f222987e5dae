// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the filter's estimate into what is published: pose, velocity and covariances in world and
// map, and in the rig's base frame; and the parts of it that the verdict and a new start keep.
#pragma once

#include "lio/filter/nav_state.hpp"
#include "lio/imu/start_state.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/pipeline/outputs.hpp"
#include "lio/stream/imu_buffer.hpp"
#include "lio/verdict/run_tally.hpp"
#include "pipeline/clock_offset_follower.hpp"
#include "pipeline/extrinsic_follower.hpp"
#include "pipeline/gate_doubt.hpp"
#include "pipeline/yaw_doubt.hpp"

namespace lio {

// A report says this besides the estimate. References are borrowed for the call.
struct ReportContext {
  const Options& options;
  Vector3 g_world;        // zero where no gravity is felt: the world is then the map's frame
  std::int64_t last_seq;  // the last scan that was fused
  TrackingStatus status;
  const ImuBuffer* imu;  // null without an IMU
  const ClockOffsetFollower& clocks;
  const ExtrinsicFollower& extrinsic;
  const YawDoubt& yaw_doubt;
  std::optional<GateDoubt> gate_doubt = {};
};

[[nodiscard]] NavOutput MakeNav(const Estimate& estimate, const ReportContext& context);
[[nodiscard]] FilterReport MakeFilterReport(const Estimate& estimate, const ScanReport& report,
                                            const ReportContext& context);
// Returns the part of a report that the verdict keeps.
[[nodiscard]] PoseRow MakePoseRow(const FilterReport& filter);
// The pose of a sound scan, as published: a start made anew goes on from here.
[[nodiscard]] LastFix MakeFix(Timestamp stamp, const Estimate& estimate, const Vector3& g_world);

}  // namespace lio
