// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/deskew.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "support/motion.hpp"
#include "support/scene.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr double kSpan_s = 0.1;

Pose Extrinsic() {
  return {ExpSo3(Vector3(0.1, -0.2, 0.9)), Vector3(0.4, -0.2, 1.1)};
}

SweepTimes TimesFrom(double start_s, double reference_s) {
  return {StampAt(start_s), StampAt(start_s + kSpan_s), StampAt(reference_s)};
}

StampedPoses PosesAlong(const test::Motion& motion, double from_s, double to_s, double step_s) {
  StampedPoses poses;
  const auto num_steps = static_cast<int>(std::lround((to_s - from_s) / step_s));
  for (int i = 0; i <= num_steps; ++i) {
    poses.push_back({StampAt(from_s + i * step_s), motion(from_s + i * step_s)});
  }
  return poses;
}

// Fixed points of the world as a moving lidar sees them, point i at i/num of the sweep.
struct Seen {
  std::vector<Vector3> points_world;
  std::vector<ScanPoint> points_lidar;
};
Seen SeeFixedPoints(const test::Motion& motion, double start_s, int num) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> somewhere(-30.0, 30.0);
  Seen seen;
  for (int i = 0; i < num; ++i) {
    const double after_s = kSpan_s * i / num;
    seen.points_world.push_back({somewhere(random), somewhere(random), somewhere(random)});
    const Pose T_lidar_world = (motion(start_s + after_s) * Extrinsic()).Inverse();
    ScanPoint point;
    point.position = (T_lidar_world * seen.points_world.back()).cast<float>();
    point.t_offset_ns = static_cast<std::uint32_t>(std::lround(1e9 * after_s));
    seen.points_lidar.push_back(point);
  }
  return seen;
}

TEST(Deskew, StationarySensorLeavesPointsUnmoved) {
  const test::Motion still = [](double) { return Pose{Extrinsic()}; };
  const Seen seen = SeeFixedPoints(still, 1.0, 200);
  const auto points_imu = Deskew(seen.points_lidar, TimesFrom(1.0, 1.05),
                                 PosesAlong(still, 1.0, 1.1, 0.01), Extrinsic());
  ASSERT_EQ(points_imu.size(), seen.points_lidar.size());
  for (std::size_t i = 0; i < points_imu.size(); ++i) {
    const Vector3 expected = Extrinsic() * seen.points_lidar[i].position.cast<double>();
    EXPECT_LT((points_imu[i].cast<double>() - expected).norm(), 1e-5) << i;
  }
}

// The poses are as dense as those of a 100 Hz IMU: the remaining error is that of linear motion
// between two of them, a dt^2 / 8 of acceleration and turn.
TEST(Deskew, InvertsTheMotionForAnyReference) {
  const test::Motion motion = test::Tumble();
  const Seen seen = SeeFixedPoints(motion, 2.0, 500);
  for (const double reference_s : {2.0, 2.05, 2.1}) {
    const auto points_imu = Deskew(seen.points_lidar, TimesFrom(2.0, reference_s),
                                   PosesAlong(motion, 1.99, 2.11, 0.01), Extrinsic());
    const Pose T_imu_world = motion(reference_s).Inverse();
    double worst_m = 0;
    for (std::size_t i = 0; i < points_imu.size(); ++i) {
      const Vector3 expected = T_imu_world * seen.points_world[i];
      worst_m = std::max(worst_m, (points_imu[i].cast<double>() - expected).norm());
    }
    EXPECT_LT(worst_m, 1e-3) << "points up to 52 m away, reference " << reference_s;
  }
}

TEST(Deskew, DenserPosesAreMoreExact) {
  const test::Motion motion = test::Tumble();
  const Seen seen = SeeFixedPoints(motion, 2.0, 300);
  const auto error_m = [&](double step_s) {
    const auto points_imu = Deskew(seen.points_lidar, TimesFrom(2.0, 2.1),
                                   PosesAlong(motion, 2.0, 2.1, step_s), Extrinsic());
    double sum = 0;
    for (std::size_t i = 0; i < points_imu.size(); ++i) {
      const Vector3 expected = motion(2.1).Inverse() * seen.points_world[i];
      sum += (points_imu[i].cast<double>() - expected).norm();
    }
    return sum / static_cast<double>(points_imu.size());
  };
  EXPECT_LT(error_m(0.05), 0.35 * error_m(0.1));  // second order: a quarter
}

// The simulated lidar's rays hit other points at each instant; after deskewing they lie on the
// world's surfaces again, and the ground is flat.
TEST(Deskew, InvertsTheSimulatedLidar) {
  const test::Motion motion = [](double t_s) { return test::WindingDrive(0.0)(t_s + 4.0); };
  test::Lidar lidar = test::TestLidar();
  lidar.range_std_m = 0.0;
  std::mt19937_64 random(1);
  std::vector<ScanPoint> points_lidar;
  for (const LidarPoint& p : test::CastSweep(test::Scene(-1.0, {}), lidar, motion, 1.0, random)) {
    points_lidar.push_back({{p.x_m, p.y_m, p.z_m}, p.t_offset_ns});
  }
  ASSERT_GT(points_lidar.size(), 3000u);
  const auto points_imu = Deskew(points_lidar, TimesFrom(1.0, 1.05),
                                 PosesAlong(motion, 1.0, 1.1, 0.01), lidar.T_imu_lidar);
  for (const Eigen::Vector3f& point : points_imu) {
    EXPECT_NEAR((motion(1.05) * point.cast<double>()).z(), -1.0, 2e-3);
  }
}

TEST(Deskew, PointsBeyondTheLastPoseTakeIt) {
  const test::Motion motion = test::Tumble();
  const StampedPoses one_pose = {{StampAt(2.0), motion(2.0)}};
  const Seen seen = SeeFixedPoints(motion, 2.0, 10);
  const auto points_imu = Deskew(seen.points_lidar, TimesFrom(2.0, 2.1), one_pose, Extrinsic());
  for (std::size_t i = 0; i < points_imu.size(); ++i) {
    const Vector3 expected = Extrinsic() * seen.points_lidar[i].position.cast<double>();
    EXPECT_LT((points_imu[i].cast<double>() - expected).norm(), 1e-4);
  }
}

TEST(Deskew, SweepOfNoLengthIsTaken) {
  const StampedPoses poses = {{StampAt(2.0), Pose{}}};
  const SweepTimes times{StampAt(2.0), StampAt(2.0), StampAt(2.0)};
  const auto points_imu = Deskew({{{1, 2, 3}, 0}}, times, poses, Pose{});
  ASSERT_EQ(points_imu.size(), 1u);
  EXPECT_LT((points_imu[0] - Eigen::Vector3f(1, 2, 3)).norm(), 1e-6f);
  EXPECT_TRUE(Deskew({}, times, poses, Pose{}).empty());
}

TEST(Deskew, RefusesToWorkWithoutPoses) {
  EXPECT_THROW(Deskew({}, TimesFrom(0, 0), {}, Pose{}), std::invalid_argument);
}

}  // namespace
}  // namespace lio
