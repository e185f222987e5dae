// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests world and map, the two frames of the published poses, on a drive that starts tilted.
#include <cmath>

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

}  // namespace
}  // namespace lio
