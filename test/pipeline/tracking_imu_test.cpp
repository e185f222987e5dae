// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scans that contradict the inertial samples, while tracking; whole drives with a broken IMU are in
// odometry_dead_imu_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::SecondsOf;

// The matches turn on from the fourth second by a rate that no sample shows.
struct TurningMatches : test::TrackingBench {
  static constexpr double kFrom_s = 4.0;

  TurningMatches() : TrackingBench(test::Straight(test::kSpeed_mps)) {}

  std::optional<Transition> MatchTurned(std::optional<double> support_at_guess) {
    MatchOutcome outcome = bench.Matched(NextJob(), motion);
    const double turned_s = std::max(0.0, SecondsOf(outcome.sweep->middle()) - kFrom_s);
    Pose& T_map_imu = outcome.match.T_map_imu;
    T_map_imu.rotation = T_map_imu.rotation * ExpSo3(Vector3(0.0, 0.0, 0.4 * turned_s));
    if (turned_s > 0.0) outcome.match.support_at_guess = support_at_guess;
    return Finish(outcome);
  }
  // Returns how it ends, within a second of turning.
  std::optional<Transition> Run(std::optional<double> support_at_guess) {
    while (sweep_start_s < kFrom_s + 1.0) {
      if (auto transition = MatchTurned(support_at_guess)) return transition;
    }
    return std::nullopt;
  }
};

TEST(TrackingImu, ScansThatLieBetterWhereTheyAreMatchedAccuseTheGyro) {
  for (const std::optional<double> support : {std::optional(0.5), std::optional<double>()}) {
    TurningMatches drive;
    const auto transition = drive.Run(support);
    ASSERT_TRUE(transition);
    ASSERT_TRUE(transition->handover.imu_doubt);
    EXPECT_EQ(transition->handover.imu_doubt->contradiction.sensor, ImuSensor::kGyro);
    EXPECT_EQ(drive.bench.counters.num_imu_contradicted, 1);
  }
}

TEST(TrackingImu, ScansThatLieAsWellWhereTheSamplesPredictThemAccuseNobody) {
  TurningMatches drive;
  EXPECT_FALSE(drive.Run(0.98));
  EXPECT_EQ(drive.bench.counters.num_imu_contradicted, 0);
}

}  // namespace
}  // namespace lio
