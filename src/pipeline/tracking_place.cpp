// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking finds the way into the initial map.
#include <fmt/format.h>

#include <numbers>

#include "lio/filter/map_change.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

void Tracking::EnterMap(const FoundPlace& place, const Sweep& sweep) {
  Estimate estimate = history_.At(sweep.middle());
  ChangeMap(place.T_initial_map, place.cov, estimate);
  BeginHistoryAt(estimate);
  KeepHistoryForQueue();
  handover_.clock_step.End();
  handover_.yaw_doubt = {};
  handover_.T_world_start = estimate.state.T_world_imu;
  handover_.T_map_start = estimate.state.T_map_imu;
  handover_.last_fix = MakeFix(estimate.stamp, estimate, g_world_);
  ForgetPoses(sweep.end);
  context_.examiner.record().BeginMap();
  context_.sensor_errors.BeginMap();
  const Vector3& at = estimate.state.T_map_imu.translation;
  context_.outputs.Notify(
      sweep.end, Notice::Severity::kInfo,
      fmt::format("found in the initial map, at x {:.2f}, y {:.2f}, z {:.2f} m, yaw {:.1f} deg; "
                  "from now on poses in map are in its frame",
                  at.x(), at.y(), at.z(),
                  YawOf(estimate.state.T_map_imu.rotation) * 180.0 / std::numbers::pi));
}

// All that remember earlier poses of the imu, in another map or of another body, forget them.
void Tracking::ForgetPoses(Timestamp stamp) {
  keyframes_.Reset();
  zero_velocity_.Forget();
  imu_agreement_.Restart();
  context_.blind_axis.Reset();
  context_.clocks.Interrupt();
  context_.convention.BeginMap(stamp);
}

}  // namespace lio
