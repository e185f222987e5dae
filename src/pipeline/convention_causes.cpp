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
  // Automatic reading did not find it: then only a statement helps, and no unit states axes.
  const bool is_automatic = rig.imu.units == ImuUnits::kAutomatic;
  const auto units_yaml = [](ImuUnits units) {
    return fmt::format("rig:\n  imu:\n    units: {}\n", EnumName(units));
  };
  if (found.R_imu_sent == Matrix3::Identity()) {
    return {{CauseKind::kImuUnits, leaves, 0.0, evidence,
             units_yaml(is_automatic ? UnitsOf(found) : ImuUnits::kAutomatic)}};
  }
  return {{CauseKind::kExtrinsicRotation, leaves, 0.0, evidence,
           ExtrinsicYaml(TurnedExtrinsic(found, rig))},
          {CauseKind::kImuAxes, leaves, 0.0, evidence,
           is_automatic ? "" : units_yaml(ImuUnits::kAutomatic)}};
}

std::string ConventionFix(const ImuConvention& found, const Rig& rig) {
  const std::string fix = "set rig.imu.units: auto";
  if (found.R_imu_sent == Matrix3::Identity()) {
    return fmt::format("{} or {}", fix, EnumName(UnitsOf(found)));
  }
  const Pose T = TurnedExtrinsic(found, rig);
  return fmt::format(
      "{}, or turn rig.T_imu_lidar: translation_m: [{:.3f}, {:.3f}, {:.3f}], rotation_wxyz: "
      "[{:.5f}, {:.5f}, {:.5f}, {:.5f}]",
      fix, T.translation.x(), T.translation.y(), T.translation.z(), T.rotation.w(), T.rotation.x(),
      T.rotation.y(), T.rotation.z());
}

}  // namespace lio
