// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/convention_causes.hpp"

#include <fmt/format.h>

#include "lio/pipeline/options_fields.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {
namespace {

// Turns the extrinsic into the axes that the messages were found to have.
Pose TurnedExtrinsic(const ImuConvention& found, const Rig& rig) {
  const Pose T = rig.T_imu_lidar.value_or(Pose{});
  return {(Quaternion(found.R_imu_sent).conjugate() * T.rotation).normalized(), T.translation};
}

}  // namespace

std::vector<Cause> ConventionCauses(const ImuConvention& found, const Rig& rig, Trust leaves,
                                    const std::string& evidence) {
  const std::string read_them = "rig:\n  imu:\n    units: auto\n";
  if (found.R_imu_sent == Matrix3::Identity()) {
    return {{CauseKind::kImuUnits, leaves, 0.0, evidence, read_them}};
  }
  return {{CauseKind::kExtrinsicRotation, leaves, 0.0, evidence,
           ExtrinsicYaml(TurnedExtrinsic(found, rig))},
          {CauseKind::kImuAxes, leaves, 0.0, evidence, read_them}};
}

std::string ConventionFix(const ImuConvention& found, const Rig& rig) {
  const auto units = static_cast<std::size_t>(UnitsOf(found));
  const std::string fix = "set rig.imu.units: auto";
  if (found.R_imu_sent == Matrix3::Identity()) {
    return fix + " or " + std::string(kEnumNames<ImuUnits>[units]);
  }
  const Pose T = TurnedExtrinsic(found, rig);
  return fmt::format(
      "{}, or turn rig.T_imu_lidar: translation_m: [{:.3f}, {:.3f}, {:.3f}], rotation_wxyz: "
      "[{:.5f}, {:.5f}, {:.5f}, {:.5f}]",
      fix, T.translation.x(), T.translation.y(), T.translation.z(), T.rotation.w(), T.rotation.x(),
      T.rotation.y(), T.rotation.z());
}

}  // namespace lio
