// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests world and map, the two frames of the published poses, on a drive that starts tilted.
#include <cmath>
#include <cstdio>

#include "lio/eval/consistency.hpp"
#include "support/simulated_run.hpp"

namespace lio {
namespace {

// The accelerometer's bias tilts the initial attitude; turns and changes of speed separate bias and
// tilt.
TEST(PublishedFrames, TheWorldBecomesLevelAndTheMapStaysAsItBegan) {
  test::SimulatedLog log({.scenario = "street", .lidar = "vlp16", .duration_s = 30.0});
  log.options.rig.imu.accel_bias_std_mps2 = 0.15;
  test::RunningEstimator estimator(log.options);
  for (sim::Message& message : log.messages) {
    if (auto* imu = std::get_if<sim::ImuMessage>(&message.body)) {
      imu->sample.f_imu_mps2 += Vector3(0.1, -0.1, 0.0);
    }
    estimator.Take(std::move(message));
  }
  const test::RunOutcome outcome = estimator.Finish(log.truth);
  EXPECT_NEAR(outcome.end_tilt_of_map_deg, std::hypot(0.1, 0.1) / 9.81 * 57.29578, 0.3);
  // Vibration hides the bias: 0.35 deg are left by then, of 0.83.
  EXPECT_LT(outcome.end_tilt_of_world_deg, 0.5);
  EXPECT_LT(outcome.end_error_m, 0.3) << "the path of 220 m is not bent";
}

class LevelWorld : public ::testing::TestWithParam<const char*> {};

// A whole drive with this IMU begins at rest, with the errors that sensors have on a vehicle: the
// rig says the data sheet's densities, which the vehicle's vibration exceeds many times. The tilt
// is judged at each scan from the first one on, so that driving off is among them.
TEST_P(LevelWorld, NeverLeavesThreeAndAHalfSigmaOfTrueGravity) {
  test::DriveSpec spec{.scenario = "street", .lidar = "vlp16"};
  spec.imu = GetParam();
  spec.duration_s.reset();
  test::SimulatedLog log(spec);
  test::RunningEstimator estimator(log.options);
  for (sim::Message& message : log.messages) estimator.Take(std::move(message));
  (void)estimator.Finish(log.truth);
  RunFiles run;
  run.truth = log.truth;
  for (const NavOutput& nav : estimator.published()) {
    run.estimate.push_back({nav.stamp, nav.T_world_imu});
    run.covariances.push_back(nav.pose_cov);
  }
  ASSERT_GT(run.estimate.size(), 500u);
  const Consistency consistency = JudgeConsistency({ComputeRunErrors(run)});
  const TiltSample largest = consistency.run_largest_tilt.front().value();
  std::printf("%s: largest tilt %.2f sigma at %.1f s\n", GetParam(), largest.sigmas,
              largest.time_s);
  EXPECT_LT(largest.sigmas, 3.5) << "at " << largest.time_s << " s";
}

INSTANTIATE_TEST_SUITE_P(All, LevelWorld, ::testing::Values("xsens_mti10", "consumer_mems"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lio
