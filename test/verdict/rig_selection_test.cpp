// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/rig_selection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verdict/rig_drive.hpp"

namespace lio::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

RigSelection Selected(const RigDrive& drive) {
  const MotionRecord record = RecordDrive(drive);
  RigFit fit(record, kAccelBiasStd_mps2);
  return {fit, fit.AlignTurns()};
}

TEST(SureSigmas, AreStudentsQuantiles) {
  EXPECT_NEAR(SureSigmas(11, 0.05), 2.228, 1e-3);  // ten degrees of freedom, as tables print it
  EXPECT_NEAR(SureSigmas(2, 0.05), 12.706, 1e-3);
  EXPECT_EQ(SureSigmas(0, 0.05), SureSigmas(2, 0.05));
}

TEST(SurePart, IsWhatIsLeftBeyondSoManyStandardDeviations) {
  const Matrix3 cov = Vector3(1.0, 4.0, 9.0).asDiagonal();
  EXPECT_EQ(SurePart(Vector3(2.0, -4.0, 6.0), cov, 2.0), 0.0);
  EXPECT_NEAR(SurePart(Vector3(5.0, -8.0, 6.0), cov, 2.0), 5.0, 1e-12);
}

TEST(Sigmas, AreTheNormOfTheWhitenedValue) {
  const Matrix3 cov = Vector3(1.0, 4.0, 9.0).asDiagonal();
  EXPECT_NEAR(Sigmas(Vector3(2.0, 4.0, 3.0), cov), 3.0, 1e-12);
}

TEST(RigSelection, ARightRigHasNoErrors) {
  const RigSelection selection = Selected(RightDrive());
  EXPECT_THAT(selection.selected(), IsEmpty());
  EXPECT_EQ(AngleDeg(selection.solution().errors.rotation), 0.0);
}

TEST(RigSelection, TheErrorThatExplainsMostIsSelected) {
  RigDrive drive = RightDrive();
  drive.T_configured.translation.x() += 1.0;
  const RigSelection selection = Selected(drive);
  EXPECT_THAT(selection.selected(), ElementsAre(CauseKind::kLeverArm));
  EXPECT_TRUE(selection.IsSelected(CauseKind::kLeverArm));
  EXPECT_FALSE(selection.IsSelected(CauseKind::kClockOffset));
  EXPECT_GT(selection.Judge(CauseKind::kLeverArm).in_tolerances, 10.0);
  EXPECT_LT(selection.Judge(CauseKind::kExtrinsicRotation).in_tolerances, 1.0);
  EXPECT_NEAR(selection.solution().errors.lever_m.x(), -1.0, 0.02);
  EXPECT_EQ(selection.solution().errors.offset_s, 0.0);  // is not free there
}

}  // namespace
}  // namespace lio::test
