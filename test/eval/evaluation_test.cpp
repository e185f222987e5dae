// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

using test::kWorldMove;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

EvaluationOptions With(AlignMode mode) {
  EvaluationOptions options;
  options.align = mode;
  return options;
}

TEST(Evaluate, APerfectEstimateInAnotherWorldHasNoErrors) {
  const Trajectory truth = test::Helix(600);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) { return kWorldMove * p; });
  const Evaluation e = Evaluate(truth, estimate, {});
  EXPECT_LT(e.ape.position_m.max, 1e-9);
  EXPECT_LT(e.ape.rotation_deg.max, 1e-6);
  EXPECT_LT(e.step.errors.translation_m.max, 1e-9);
  EXPECT_LT(e.drift.translation_percent, 1e-9);
  EXPECT_LT(e.end.error_m, 1e-9);
  EXPECT_THAT(e.notes, IsEmpty());
  EXPECT_NEAR(e.duration_s, 59.9, 1e-9);
  EXPECT_NEAR(e.path_length_m, 599 * std::hypot(0.4, 0.01), 0.01);
}

TEST(Evaluate, AKnownShiftIsTheApeWithoutAlignment) {
  const Trajectory truth = test::Helix(100);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{p.rotation, p.translation + Vector3(0.3, 0.4, -1.2)};
  });
  const Evaluation e = Evaluate(truth, estimate, With(AlignMode::kNone));
  EXPECT_NEAR(e.ape.position_m.rmse, 1.3, 1e-9);
  EXPECT_NEAR(e.ape.horizontal_m.median, 0.5, 1e-9);
  EXPECT_NEAR(e.ape.vertical_m.max, 1.2, 1e-9);
  EXPECT_LT(Evaluate(truth, estimate, {}).ape.position_m.max, 1e-9);
}

// Positions alternate by +-0.1 m along z about the truth, so the alignment changes nothing.
TEST(Evaluate, ApeAfterAlignmentIsTheResidual) {
  const Trajectory truth = test::Helix(400);
  Trajectory estimate = test::Map(truth, [](const Pose& p) { return kWorldMove * p; });
  for (std::size_t i = 0; i < 400; ++i) {
    estimate.poses[i].pose.translation +=
        kWorldMove.rotation * Vector3(0, 0, i % 2 == 0 ? 0.1 : -0.1);
  }
  const Evaluation e = Evaluate(truth, estimate, {});
  EXPECT_NEAR(e.ape.position_m.rmse, 0.1, 1e-4);
  EXPECT_NEAR(e.ape.vertical_m.mean, 0.1, 1e-3);
  EXPECT_NEAR(e.step.errors.translation_m.median, 0.2, 1e-6);
}

TEST(Evaluate, TiltIsTheAngleBetweenVerticalsAndIgnoresYaw) {
  const Trajectory truth = test::Helix(300);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{ExpSo3({0, 0, 1.5}), Vector3::Zero()} * p *
           Pose{ExpSo3({2 * test::kDeg, 0, 0}), Vector3::Zero()};
  });
  const Evaluation e = Evaluate(truth, estimate, {});
  ASSERT_TRUE(e.tilt_deg.has_value());
  EXPECT_NEAR(e.tilt_deg->mean, 2, 1e-6);
  EXPECT_NEAR(e.tilt_deg->max, 2, 1e-6);
}

TEST(Evaluate, HeightDriftIsMeasuredFromTheStartWithoutAlignment) {
  const Trajectory truth = test::Straight(101, 1.0);
  const Trajectory estimate = test::MakeTrajectory(101, [](int i) {
    return Pose{Quaternion::Identity(), {1.0 * i, 0, 7 - 0.02 * i}};
  });
  const Evaluation e = Evaluate(truth, estimate, {});
  ASSERT_TRUE(e.height.has_value());
  EXPECT_NEAR(e.height->end_m, -2, 1e-9);
  EXPECT_NEAR(e.height->end_percent, 2, 1e-9);
  EXPECT_NEAR(e.height->max_m, 2, 1e-9);
}

// The estimate closes a square of 100 m with 3 m aside: the gap is 3 m, 0.75 % of 400 m.
TEST(Evaluate, EndErrorOfAnUnclosedLoop) {
  const auto corner = [](int i) {
    const int side = i / 100, along = i % 100;
    const Vector3 starts[] = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}, {0, 0, 0}};
    const Vector3 directions[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}};
    return Vector3(starts[side] + along * directions[side]);
  };
  const Trajectory truth = test::MakeTrajectory(401, [&](int i) {
    return Pose{Quaternion::Identity(), corner(i)};
  });
  const Trajectory estimate = test::MakeTrajectory(401, [&](int i) {
    return Pose{Quaternion::Identity(), corner(i) + Vector3(0, 3.0 * i / 400, 0)};
  });
  const Evaluation e = Evaluate(truth, estimate, {});
  EXPECT_NEAR(e.path_length_m, 400, 1e-9);
  EXPECT_NEAR(e.end.truth_gap_m, 0, 1e-9);
  EXPECT_NEAR(e.end.estimate_gap_m, 3, 1e-9);
  EXPECT_NEAR(e.end.error_m, 3, 1e-9);
  EXPECT_NEAR(e.end.error_percent, 0.75, 1e-9);
  EXPECT_NEAR(e.end.rotation_error_deg, 0, 1e-9);
}

// A published figure made this mistake: poses of a lidar were compared with those of a camera. The
// rotation error of 120 deg is named, and does not spoil the relative figures.
TEST(Evaluate, CameraAxesAreNamedAndTakenOutOfRelativeErrors) {
  Matrix3 axes;
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Pose T_vehicle_camera{Quaternion(axes), Vector3::Zero()};
  const Trajectory truth = test::Helix(600);
  const Trajectory estimate = test::Map(truth, [&](const Pose& p) { return p * T_vehicle_camera; });
  const Evaluation e = Evaluate(truth, estimate, {});
  EXPECT_LT(e.ape.position_m.max, 1e-9);
  EXPECT_NEAR(e.ape.rotation_deg.mean, 120, 1e-6);
  EXPECT_LT(e.ape.rotation_without_offset_deg.max, 1e-6);
  EXPECT_LT(e.drift.translation_percent, 1e-6);
  EXPECT_LT(e.step.errors.translation_m.max, 1e-9);
  EXPECT_THAT(e.notes, Contains(HasSubstr("the estimate is in camera axes")));
}

TEST(Evaluate, AStraightPathStillShowsBodiesThatLookElsewhere) {
  const Trajectory truth = test::Straight(100, 1);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return p * Pose{ExpSo3({0, 0, 90 * test::kDeg}), Vector3::Zero()};
  });
  EXPECT_THAT(Evaluate(truth, estimate, {}).notes,
              Contains(HasSubstr("direction of travel 90.0 deg apart")));
}

TEST(Evaluate, WorldsTurnedAgainstEachOtherAreNotedWithoutAlignment) {
  const Trajectory truth = test::Helix(600);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{ExpSo3({0, 0, 0.5}), Vector3::Zero()} * p;
  });
  EXPECT_THAT(Evaluate(truth, estimate, With(AlignMode::kNone)).notes,
              Contains(HasSubstr("turned by 28.6 deg")));
}

TEST(Evaluate, KittiFilesHaveNoHeightTiltOrTime) {
  const Trajectory truth = test::AsKitti(test::Helix(100));
  Trajectory estimate = truth;
  estimate.poses.resize(90);
  const Evaluation e = Evaluate(truth, estimate, {});
  EXPECT_FALSE(e.height.has_value());
  EXPECT_FALSE(e.tilt_deg.has_value());
  EXPECT_EQ(e.duration_s, 0);
  EXPECT_THAT(e.notes, Contains(HasSubstr("10 frames are missing")));
  EXPECT_THAT(e.notes, Contains(HasSubstr("wrong from the first missing frame on")));
}

TEST(Evaluate, RpeRowsAreAlwaysListedAndEmptyWhenTooLong) {
  const Evaluation e = Evaluate(test::Straight(61, 1), test::Straight(61, 1), {});
  ASSERT_EQ(e.rpe.size(), 4u);
  EXPECT_EQ(e.rpe[1].span, "10m");
  EXPECT_TRUE(e.rpe[0].errors && e.rpe[1].errors && e.rpe[2].errors);
  EXPECT_FALSE(e.rpe[3].errors.has_value());
}

}  // namespace
}  // namespace lio
