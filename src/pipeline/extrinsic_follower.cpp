// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/extrinsic_follower.hpp"

#include <utility>

namespace lio {

ExtrinsicFollower::ExtrinsicFollower(const Options& options,
                                     const std::optional<ExtrinsicStd>& found_std)
    : is_on_(options.filter.estimate_extrinsic && options.pipeline.use_imu),
      T_configured_(options.rig.T_imu_lidar.value_or(Pose{})),
      T_imu_lidar_(T_configured_),
      found_std_(found_std),
      std_(found_std) {}

void ExtrinsicFollower::Restart() {
  T_imu_lidar_ = T_configured_;
  is_corrected_ = false;
  std_ = found_std_;
}

std::optional<Pose> ExtrinsicFollower::Take(const RigFindings& findings) {
  if (!is_on_) return std::nullopt;
  const auto& found =
      findings.T_imu_lidar || !is_corrected_ ? findings.T_imu_lidar : findings.T_imu_lidar_bettered;
  is_corrected_ |= found.has_value();
  if (is_corrected_ && findings.extrinsic_std) std_ = findings.extrinsic_std;
  if (!found) return std::nullopt;
  const Pose T_old_lidar = std::exchange(T_imu_lidar_, *found);
  return T_old_lidar * T_imu_lidar_.Inverse();
}

}  // namespace lio
