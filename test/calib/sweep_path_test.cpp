// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/sweep_path.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/motion.hpp"

namespace lio {
namespace {

// The person makes a step and a half each second, and the body sways with it.
Pose Walk(double t_s) {
  const double phase = 2.0 * M_PI * 1.5 * t_s;
  return {ExpSo3(Vector3(0.03 * std::sin(phase), 0.02 * std::cos(phase), 0.4 * t_s)),
          Vector3(1.2 * t_s, 0.02 * std::sin(phase), 0.03 * std::cos(2.0 * phase))};
}

SweepPath MakePath() {
  StampedPoses known;
  for (double t_s = 0.0; t_s < 5.0; t_s += 0.1) known.push_back({test::StampAt(t_s), Walk(t_s)});
  return {known, test::ExactSamples(Walk, -0.1, 5.1, 0.01)};
}

TEST(SweepPath, PassesThroughWhatIsKnown) {
  const SweepPath path = MakePath();
  for (const double t_s : {0.0, 1.3, 4.9}) {
    const Pose error = Walk(t_s).Inverse() * path.At(test::StampAt(t_s));
    EXPECT_LT(LogSe3(error).norm(), 1e-9) << t_s;
  }
}

TEST(SweepPath, FollowsAWalkBetweenSweeps) {
  const SweepPath path = MakePath();
  for (double t_s = 1.0; t_s < 4.0; t_s += 0.0137) {
    const Pose error = Walk(t_s).Inverse() * path.At(test::StampAt(t_s));
    EXPECT_LT(error.translation.norm(), 0.0025) << t_s;  // a twelfth of the bounce at three hertz
    EXPECT_LT(LogSo3(error.rotation).norm(), 1e-4) << t_s;
  }
}

TEST(SweepPath, HasAPoseForEveryRateOfASweep) {
  const SweepPath path = MakePath();
  const StampedPoses poses = path.Between(test::StampAt(2.003), test::StampAt(2.103));
  ASSERT_EQ(poses.size(), 12u);
  EXPECT_EQ(poses.front().stamp, test::StampAt(2.003));
  EXPECT_EQ(poses.back().stamp, test::StampAt(2.103));
  for (std::size_t i = 1; i < poses.size(); ++i) EXPECT_GT(poses[i].stamp, poses[i - 1].stamp);
}

TEST(SweepPath, GoesStraightOnBeyondItsEnds) {
  const SweepPath path = MakePath();
  const Pose before = path.At(test::StampAt(-0.05));
  EXPECT_LT((before.translation - Walk(-0.05).translation).norm(), 0.05);  // the bounce
}

TEST(SweepPath, RefusesTooLittle) {
  EXPECT_THROW(SweepPath({}, test::ExactSamples(Walk, 0.0, 1.0, 0.01)), std::invalid_argument);
  EXPECT_THROW(SweepPath({{test::StampAt(0), Pose{}}, {test::StampAt(1), Pose{}}}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace lio
