// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The extrinsic between lidar and IMU that is in use: the rig's until a look at the drive
// (verdict/rig_findings.hpp) is sure that it is wrong, then the one that the motion shows. A rig
// that is right within the tolerances of that look is never touched.
#pragma once

#include <optional>

#include "lio/pipeline/options.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {

class ExtrinsicFollower {
 public:
  // Keeps the rig's where filter.estimate_extrinsic is off, or no IMU is used.
  // `found_std`: an earlier pass has found it.
  explicit ExtrinsicFollower(const Options& options,
                             const std::optional<ExtrinsicStd>& found_std = {});

  const Pose& T_imu_lidar() const { return T_imu_lidar_; }
  // Nothing while the rig's is in use.
  std::optional<Pose> corrected() const {
    return is_corrected_ ? std::optional(T_imu_lidar_) : std::nullopt;
  }
  // How well it was found; nothing while the rig's is in use.
  const std::optional<ExtrinsicStd>& std() const { return std_; }
  // Takes what a look has found. Returns T_old_new, the pose of the imu by the corrected extrinsic
  // in the imu so far, when it corrects the extrinsic.
  [[nodiscard]] std::optional<Pose> Take(const RigFindings& findings);
  // The samples are read in other axes from here on: back to the rig's extrinsic.
  void Restart();

 private:
  bool is_on_;
  Pose T_configured_;
  Pose T_imu_lidar_;
  bool is_corrected_ = false;
  std::optional<ExtrinsicStd> found_std_;  // by an earlier pass
  std::optional<ExtrinsicStd> std_;
};

}  // namespace lio
