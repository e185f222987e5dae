// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator's outputs of the state in each frame.
#include <gtest/gtest.h>

#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::RunOdometry;
using test::RunResult;
using test::StaticStartDrive;

TEST(Odometry, TheBaseFramesMotionIsTheImusMovedByHand) {
  Options options = test::DriveRig();
  EXPECT_FALSE(RunOdometry(StaticStartDrive(), options).scans.back().filter->nav.base);
  const Pose T_base_imu{ExpSo3(Vector3(0.1, 0, 1)), Vector3(1, -0.2, 0.5)};
  options.rig.T_base_imu = T_base_imu;
  const RunResult run = RunOdometry(StaticStartDrive(), options);
  std::vector<NavOutput> navs = run.navs;
  for (const ScanOutput& scan : run.scans) navs.push_back(scan.filter->nav);
  ASSERT_GT(navs.size(), 400u);
  for (const NavOutput& nav : navs) {
    ASSERT_TRUE(nav.base);
    const Pose expected = nav.T_world_imu * T_base_imu.Inverse();
    EXPECT_LT(LogSe3(expected.Inverse() * nav.base->T_world_base).norm(), 1e-9);
    const Pose in_map = nav.T_map_imu * T_base_imu.Inverse();
    EXPECT_LT(LogSe3(in_map.Inverse() * nav.base->T_map_base).norm(), 1e-9);
    const Vector3 turning = nav.w_imu_radps.cross(T_base_imu.Inverse().translation);
    const Vector3 velocity = nav.v_world_imu_mps + nav.T_world_imu.rotation * turning;
    EXPECT_LT((velocity - nav.base->v_world_base_mps).norm(), 1e-12);
    EXPECT_GT(nav.base->velocity_cov.trace(), 0.0);
  }
}

// Nothing levels a world in which no gravity is felt: it is the map's frame.
TEST(Odometry, WithoutGravityTheWorldIsTheMap) {
  Options options = test::DriveRig();
  options.pipeline.use_imu = false;
  const RunResult run = RunOdometry(StaticStartDrive(), options);
  ASSERT_GT(run.scans.size(), 10u);
  for (const ScanOutput& scan : run.scans) {
    const NavOutput& nav = scan.filter->nav;
    EXPECT_EQ(nav.T_world_imu.translation, nav.T_map_imu.translation);
    EXPECT_EQ(nav.T_world_imu.rotation.coeffs(), nav.T_map_imu.rotation.coeffs());
    EXPECT_LT((nav.v_world_imu_mps - scan.filter->v_map_imu_mps).norm(), 1e-12);
    EXPECT_EQ(nav.pose_cov, scan.filter->map_as_world_cov);
    EXPECT_EQ(nav.pose_cov, (scan.filter->cov.topLeftCorner<6, 6>())) << "of the same pose";
  }
}

}  // namespace
}  // namespace lio
