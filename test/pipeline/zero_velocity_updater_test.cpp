// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/zero_velocity_updater.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::kGravity;
using test::StampAt;

constexpr double kSwayVariance = 0.0025 * 0.0025;  // variance of a body's sway at rest [(m/s)^2]

struct Belief {
  double speed_mps = 0.0;
  double speed_std_mps = 10.0;
};

// Feeds a filter of an IMU at rest, without noise, with ten scans a second of a lidar at rest.
class RestingFilter {
 public:
  explicit RestingFilter(const Belief& belief = {})
      : history_(Settings(), Start(belief), Sample(0)) {
    for (int i = 1; i <= 250; ++i) (void)history_.AddImu(Sample(i));
  }

  // The scan whose middle is at `middle_s`.
  bool AddScan(ZeroVelocityUpdater& updater, double middle_s, double position_m = 0.0,
               unsigned degenerate_mask = 0) {
    Sweep sweep;
    sweep.start = StampAt(middle_s - 0.05);
    sweep.end = StampAt(middle_s + 0.05);
    MatchOutcome outcome;
    outcome.sweep = std::make_shared<Sweep>(sweep);
    outcome.match.status = MatchStatus::kConverged;
    outcome.match.T_map_imu.translation.x() = position_m;
    outcome.match.degenerate_mask = degenerate_mask;
    return updater.AddFusedScan(outcome, kGravity, history_);
  }

  double SpeedVarianceAt(double t_s) const { return history_.At(StampAt(t_s)).cov(kVel, kVel); }
  double SpeedAt(double t_s) const { return history_.At(StampAt(t_s)).state.v_world_imu.x(); }

 private:
  static HistoryOptions Settings() {
    HistoryOptions options;
    options.g_world = kGravity;
    return options;
  }
  static ImuSample Sample(int i) { return {StampAt(0.01 * i), Vector3::Zero(), -kGravity}; }
  static Estimate Start(const Belief& belief) {
    Estimate estimate;
    estimate.stamp = StampAt(0.0);
    estimate.state.v_world_imu.x() = belief.speed_mps;
    estimate.cov.block<3, 3>(kVel, kVel) =
        belief.speed_std_mps * belief.speed_std_mps * Matrix3::Identity();
    return estimate;
  }

  FilterHistory history_;
};

TEST(ZeroVelocityUpdater, AfterAStartAtRestTheFirstScanIsFusedAsRest) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest({0.5, 10.0});
  EXPECT_TRUE(rest.AddScan(updater, 0.1));
  EXPECT_NEAR(rest.SpeedAt(0.1), 0.0, 1e-4);
}

TEST(ZeroVelocityUpdater, OtherwiseRestIsFusedOnceTheWindowIsFull) {
  ZeroVelocityUpdater updater({}, false);
  RestingFilter rest;
  for (int k = 0; k < 15; ++k) EXPECT_FALSE(rest.AddScan(updater, 0.1 + 0.1 * k)) << k;
  EXPECT_NEAR(rest.SpeedVarianceAt(1.5), 100.0, 1e-6);
  EXPECT_TRUE(rest.AddScan(updater, 1.65));
  EXPECT_LT(rest.SpeedVarianceAt(1.65), 1e-3);
}

// A body sways to and fro within 0.3 s: measurements so far apart are correlated by exp(-d / 0.3
// s).
double NumAlike(double since_s) {
  return 1.0 / std::tanh(0.5 * since_s / 0.3);
}

TEST(ZeroVelocityUpdater, TheFirstMeasurementCountsAsOneAfterTheSway) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  rest.AddScan(updater, 0.1);
  const double expected = NumAlike(0.3) * kSwayVariance;
  EXPECT_NEAR(rest.SpeedVarianceAt(0.1), expected, 1e-3 * expected);
}

TEST(ZeroVelocityUpdater, MeasurementsThatFollowSoonerHaveLargerVariances) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  rest.AddScan(updater, 0.1);
  rest.AddScan(updater, 0.2);
  EXPECT_NEAR(NumAlike(0.1), 6.05, 0.01);
  const double expected = kSwayVariance / (1.0 / NumAlike(0.3) + 1.0 / NumAlike(0.1));
  EXPECT_NEAR(rest.SpeedVarianceAt(0.2), expected, 1e-3 * expected);
}

TEST(ZeroVelocityUpdater, MeasurementsFartherApartThanTheSwayLastsAreNearlyIndependent) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  rest.AddScan(updater, 0.1);
  rest.AddScan(updater, 0.55);
  EXPECT_NEAR(NumAlike(0.45), 1.6, 0.05);
  const double expected = kSwayVariance / (1.0 / NumAlike(0.3) + 1.0 / NumAlike(0.45));
  EXPECT_NEAR(rest.SpeedVarianceAt(0.55), expected, 1e-3 * expected);
}

TEST(ZeroVelocityUpdater, MatchesAtRestAreLessSure) {
  ZeroVelocityUpdater updater({}, true);
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
  RestingFilter rest;
  rest.AddScan(updater, 0.1);
  EXPECT_EQ(updater.match_cov_factor(), 4.0);
}

TEST(ZeroVelocityUpdater, MotionEndsIt) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  ASSERT_TRUE(rest.AddScan(updater, 0.1));
  EXPECT_FALSE(rest.AddScan(updater, 0.2, 0.2));
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
  EXPECT_FALSE(rest.AddScan(updater, 0.3, 0.2)) << "a full window of rest is needed again";
}

TEST(ZeroVelocityUpdater, AScanThatIsNotObservableInAllDirectionsBeginsTheWindowAnew) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  ASSERT_TRUE(rest.AddScan(updater, 0.1));
  EXPECT_FALSE(rest.AddScan(updater, 0.2, 0.0, 0b1));
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
  for (int k = 0; k < 15; ++k) EXPECT_FALSE(rest.AddScan(updater, 0.3 + 0.1 * k)) << k;
  EXPECT_TRUE(rest.AddScan(updater, 1.85));
}

TEST(ZeroVelocityUpdater, AfterForgettingTheWindowBeginsAnew) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest;
  ASSERT_TRUE(rest.AddScan(updater, 0.1));
  updater.Forget();
  EXPECT_FALSE(rest.AddScan(updater, 0.2));
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
}

TEST(ZeroVelocityUpdater, RestThatAFilterSureOfItsSpeedRefusesIsNotTakenForFused) {
  ZeroVelocityUpdater updater({}, true);
  RestingFilter rest({1.0, 0.001});
  EXPECT_FALSE(rest.AddScan(updater, 0.1));
  EXPECT_NEAR(rest.SpeedAt(0.1), 1.0, 1e-9);
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
}

TEST(ZeroVelocityUpdater, AfterForgettingMatchesCountInFullAgain) {
  RestingFilter rest;
  ZeroVelocityUpdater updater(ImuRig{}, true);
  ASSERT_TRUE(rest.AddScan(updater, 0.1));
  ASSERT_GT(updater.match_cov_factor(), 1.0);
  updater.Forget();
  EXPECT_EQ(updater.match_cov_factor(), 1.0);
}

}  // namespace
}  // namespace lio
