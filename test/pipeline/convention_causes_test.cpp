// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/convention_causes.hpp"

#include <gtest/gtest.h>

#include "lio/base/rotation.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {
namespace {

// The messages' x axis points to the rig's left.
ImuConvention Turned() {
  ImuConvention convention;
  convention.R_imu_sent << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return convention;
}

TEST(ConventionCauses, OtherUnitsAreCalledUnits) {
  ImuConvention in_g;
  in_g.is_in_g = true;
  const std::vector<Cause> causes = ConventionCauses(in_g, Rig{}, Trust::kNo, "why");
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_EQ(causes[0].kind, CauseKind::kImuUnits);
  EXPECT_EQ(causes[0].evidence, "why");
  EXPECT_EQ(causes[0].fix, "rig:\n  imu:\n    units: g\n") << "automatic reading did not find it";
  Rig stated;
  stated.imu.units = ImuUnits::kSi;
  EXPECT_EQ(ConventionCauses(in_g, stated, Trust::kNo, "why")[0].fix,
            "rig:\n  imu:\n    units: auto\n");
  EXPECT_EQ(ConventionFix(in_g, Rig{}), "set rig.imu.units: auto or g");
}

TEST(ConventionCauses, TurnedAxesAndATurnedExtrinsicAreBothNamedAndTheTranslationStays) {
  Rig rig;
  rig.T_imu_lidar.emplace();
  rig.T_imu_lidar->translation = {0.1, 0.2, 0.3};
  const std::vector<Cause> causes = ConventionCauses(Turned(), rig, Trust::kDoubtful, "why");
  ASSERT_EQ(causes.size(), 2U);
  EXPECT_EQ(causes[0].kind, CauseKind::kExtrinsicRotation);
  EXPECT_EQ(causes[1].kind, CauseKind::kImuAxes);
  const Pose corrected{Quaternion(Matrix3(Turned().R_imu_sent.transpose())),
                       rig.T_imu_lidar->translation};
  EXPECT_EQ(causes[0].fix, ExtrinsicYaml(corrected));
  EXPECT_EQ(causes[1].fix, "") << "the axes are read automatically already";
  for (const Cause& cause : causes) EXPECT_EQ(cause.leaves, Trust::kDoubtful);
}

}  // namespace
}  // namespace lio
