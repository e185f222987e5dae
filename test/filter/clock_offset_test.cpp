// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

constexpr double kScan_s = 0.1;
constexpr double kTurnStd_rad = 5e-4;

constexpr double kGyroDensity = 5e-4;

// The lidar sends ten scans per second, and its clock is `offset_s` behind the IMU's.
struct Drive {
  test::SmoothMotion motion;
  double offset_s = 0.02;
  double outlier_rad = 0.0;    // error of every tenth scan
  double extra_std_rad = 0.0;  // error of each scan, beyond what matching claims
  double imu_rate_hz = 100.0;
  double rate = 0.0;  // the offset grows by this, s per second

  double OffsetAt(double seen_s) const { return offset_s + rate * seen_s; }

  void Run(ClockOffset& clock, int from_scan, int to_scan) {
    const test::ImuErrors errors{gyro_bias, Vector3::Zero(), kGyroDensity, 0.0};
    for (int k = from_scan; k < to_scan; ++k) {
      const double moved_by_s = clock.move_by_s();
      const double seen_s = kScan_s * (k + 0.5);  // by the IMU's clock
      const double stamp_s = seen_s - OffsetAt(seen_s) + moved_by_s;
      const Vector3 error = test::NormalVector(random, std::hypot(kTurnStd_rad, extra_std_rad)) +
                            (k % 10 == 0 ? outlier_rad : 0.0) * Vector3::UnitX();
      const std::vector<ImuSample> samples = test::ReadImu(
          motion, stamp_s - 0.5 * kScan_s, stamp_s + 0.5 * kScan_s, imu_rate_hz, errors, random);
      clock.Add({Timestamp{} + Duration::FromSeconds(stamp_s), moved_by_s,
                 motion.At(seen_s).T_world_imu.rotation * ExpSo3(error),
                 kTurnStd_rad * kTurnStd_rad, gyro_bias, kGyroDensity},
                samples);
    }
  }

  const Vector3 gyro_bias{0.003, -0.002, 0.001};
  std::mt19937_64 random{5};
};

TEST(ClockOffset, AWalkShowsItToAMillisecond) {
  for (const double offset_s : {0.02, -0.035, 0.0}) {
    ClockOffset clock;
    Drive drive{test::WalkMotion(), offset_s};
    drive.Run(clock, 0, 200);
    EXPECT_NEAR(clock.offset_s(), offset_s, 1e-3);
    EXPECT_LT(std::abs(clock.offset_s() - offset_s), 4.0 * clock.std_s());
    EXPECT_LT(clock.std_s(), 1e-3);
    EXPECT_NEAR(clock.move_by_s(), offset_s, 1e-3) << "stamps are moved by what is known";
  }
}

// Four parts in a hundred thousand are 2.4 ms in a minute.
TEST(ClockOffset, TheBeginOfADriveIsKnownAtItsEnd) {
  ClockOffset first;
  Drive drive{test::WalkMotion()};
  drive.rate = 4e-5;
  drive.Run(first, 0, 600);
  const ClockBelief begin = first.AtFirstScan();
  const double std_s = std::sqrt(begin.cov(0, 0));
  EXPECT_LT(std::abs(begin.mean[0] - drive.offset_s), 4.0 * std_s);
  EXPECT_LT(std_s, 1e-3);
  EXPECT_GT(std_s, first.std_s()) << "a minute ago the clocks were another minute apart";

  ClockOffset second(begin);
  Drive again{test::WalkMotion()};
  again.rate = 4e-5;
  EXPECT_EQ(second.offset_s(), begin.mean[0]);
  EXPECT_DOUBLE_EQ(second.std_s(), std_s);
  again.Run(second, 0, 20);
  EXPECT_NEAR(second.offset_s(), drive.offset_s, 1e-3);
  EXPECT_NEAR(second.move_by_s(), drive.offset_s, 1e-3);
}

TEST(ClockOffset, AFewTurnsTellNothingOfTheFirstScan) {
  for (const int num_scans : {0, 4}) {
    ClockOffset clock;
    Drive{test::WalkMotion()}.Run(clock, 0, num_scans);
    EXPECT_EQ(clock.AtFirstScan().mean, ClockBelief().mean) << num_scans;
    EXPECT_EQ(clock.AtFirstScan().cov, ClockBelief().cov) << num_scans;
  }
}

TEST(ClockOffset, AStraightRoadLeavesItWhereItIs) {
  test::SmoothMotion straight;
  straight.x.speed = 28.0;
  ClockOffset clock;
  Drive{straight}.Run(clock, 0, 600);
  EXPECT_EQ(clock.offset_s(), 0.0) << "before anything is known";
  EXPECT_EQ(clock.move_by_s(), 0.0);

  Drive drive{test::WalkMotion()};
  drive.Run(clock, 1000, 1200);
  const double found_s = clock.offset_s();
  const double rate_std = clock.rate_std();
  Drive{straight}.Run(clock, 1200, 7200);
  EXPECT_LT(std::abs(clock.offset_s() - found_s), 600.0 * 3.0 * rate_std) << "ten minutes later";
  EXPECT_GT(clock.std_s(), 600.0 * rate_std) << "oscillators that nobody compares drift apart";
}

// Four parts in a hundred thousand are 12 ms in five minutes.
TEST(ClockOffset, ASlowDriftIsFollowed) {
  for (const double rate : {4e-5, -4e-5, 0.0}) {
    ClockOffset clock;
    Drive drive{test::WalkMotion()};
    drive.rate = rate;
    for (int minute = 0; minute < 5; ++minute) {
      drive.Run(clock, 600 * minute, 600 * (minute + 1));
      const double offset_s = drive.OffsetAt(60.0 * (minute + 1));
      EXPECT_LT(std::abs(clock.offset_s() - offset_s), 4.0 * clock.std_s()) << minute;
      EXPECT_NEAR(clock.offset_s(), offset_s, 5e-4) << "after minute " << minute;
      EXPECT_NEAR(clock.move_by_s(), offset_s, 5e-4) << "after minute " << minute;
    }
    EXPECT_NEAR(clock.rate(), rate, 3.0 * clock.rate_std());
    EXPECT_LT(clock.rate_std(), 5e-6);
  }
}

// The clocks were set: an hour passed by their stamps, none by the oscillators.
TEST(ClockOffset, SetClocksDoNotDrift) {
  ClockOffset clock;
  Drive drive{test::WalkMotion()};
  drive.rate = 4e-5;
  drive.Run(clock, 0, 1200);
  const double found_s = clock.offset_s(), std_s = clock.std_s();
  for (const int scan : {37'200, 0}) {
    clock.Interrupt();
    drive.Run(clock, scan, scan + 1);
    EXPECT_EQ(clock.offset_s(), found_s) << scan;
    EXPECT_EQ(clock.std_s(), std_s) << scan;
  }
}

TEST(ClockOffset, StaysWithinItsBounds) {
  ClockOffset clock;
  Drive{test::WalkMotion(), 0.16}.Run(clock, 0, 400);
  EXPECT_LE(clock.offset_s(), ClockOffset::kMax_s);
  EXPECT_LE(clock.move_by_s(), ClockOffset::kMax_s);
  // The bound is what holds it: an estimator that learns nothing would be at zero.
  EXPECT_GT(clock.offset_s(), 0.9 * ClockOffset::kMax_s);
  EXPECT_GT(clock.move_by_s(), 0.9 * ClockOffset::kMax_s);

  ClockOffset negative;
  Drive{test::WalkMotion(), -0.16}.Run(negative, 0, 400);
  EXPECT_GE(negative.offset_s(), -ClockOffset::kMax_s);
  EXPECT_LT(negative.offset_s(), -0.9 * ClockOffset::kMax_s);
  EXPECT_LT(negative.move_by_s(), -0.9 * ClockOffset::kMax_s);
}

TEST(ClockOffset, WrongMatchesDoNotMoveIt) {
  ClockOffset clock;
  Drive{test::WalkMotion(), 0.02, 0.05}.Run(clock, 0, 300);
  EXPECT_NEAR(clock.offset_s(), 0.02, 2e-3);
}

TEST(ClockOffset, StampsAreMovedSlowly) {
  ClockOffset clock;
  Drive drive{test::WalkMotion(), 0.03};
  double last_s = 0.0;
  for (int k = 0; k < 100; ++k) {
    drive.Run(clock, k, k + 1);
    EXPECT_LE(std::abs(clock.move_by_s() - last_s), 2e-3 + 1e-12);
    last_s = clock.move_by_s();
  }
  EXPECT_NEAR(last_s, 0.03, 1e-3);
}

// Three standard deviations off is off for sure, however unsure by how much.
TEST(ClockOffset, StampsAreMovedAsSoonAsTheyAreOffForSure) {
  for (const double offset_s : {0.03, 0.0}) {
    ClockOffset clock;
    Drive drive{test::WalkMotion(), offset_s};
    drive.Run(clock, 0, 8);
    EXPECT_EQ(std::abs(clock.move_by_s()) > 1e-3, offset_s != 0.0) << offset_s;
  }
}

// One wrong match may look like an offset.
TEST(ClockOffset, AFewTurnsAloneMoveNoStamps) {
  ClockOffset clock;
  Drive drive{test::WalkMotion(), 0.03};
  drive.Run(clock, 0, 5);  // four turns
  EXPECT_GT(clock.offset_s(), 0.01);
  EXPECT_EQ(clock.move_by_s(), 0.0);
}

// The scatter of turns is learned from the drive: a quiet matcher is trusted more.
TEST(ClockOffset, StandardDeviationFollowsTheScatterOfTheTurns) {
  double stds_s[2] = {};
  for (int i = 0; i < 2; ++i) {
    ClockOffset clock;
    Drive drive{test::WalkMotion(), 0.02};
    drive.extra_std_rad = i == 0 ? 0.0 : 2e-3;
    drive.Run(clock, 0, 200);
    stds_s[i] = clock.std_s();
    EXPECT_LT(std::abs(clock.offset_s() - 0.02), 4.0 * clock.std_s());
  }
  EXPECT_GT(stds_s[1], 2.0 * stds_s[0]);
}

// A sample is missing, and the line across does not follow the motion.
TEST(ClockOffset, TurnsOfSparseSamplesAreLeftOut) {
  ClockOffset clock;
  Drive drive{test::WalkMotion()};
  drive.imu_rate_hz = 25.0;
  drive.Run(clock, 0, 100);
  EXPECT_EQ(clock.offset_s(), 0.0);
}

TEST(ClockOffset, ATurnAcrossALostScanIsLeftOut) {
  ClockOffset clock;
  Drive drive{test::WalkMotion()};
  for (int k = 0; k < 50; ++k) {
    drive.Run(clock, k, k + 1);
    clock.Interrupt();
  }
  EXPECT_EQ(clock.offset_s(), 0.0);
}

}  // namespace
}  // namespace lio
