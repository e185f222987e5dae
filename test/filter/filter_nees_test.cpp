// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests whether the covariance agrees with the errors when all of the filter's assumptions hold:
// noise as modelled, and a map that does not move. test/consistency has maps that drift.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "filter/tumbling_filter.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;
using test::kTumbleStep_s;
using test::PoseAt;
using test::SampleAt;
using test::StampAt;
using test::StartEstimate;
using test::TestMotion;
using test::TestOptions;

struct TruthRun {
  NavState truth;
  Estimate estimate;
};

// Runs ten seconds of noisy samples, and of poses in a map that is fixed where the first scan put
// it.
TruthRun RunWithNoise(unsigned seed, double seconds) {
  constexpr double kPoseStd = 0.02;
  std::mt19937_64 random(seed);
  HistoryOptions options = TestOptions();
  options.nis_limit = std::numeric_limits<double>::infinity();
  const ProcessNoise& noise = options.noise;

  TruthRun run;
  Estimate start = StartEstimate();
  const ErrorVector start_error = test::DrawFrom(start.cov, random);
  NavState truth = start.state;
  start.state = BoxPlus(truth, start_error);
  start.state.T_map_imu = start.state.T_world_imu;
  const Pose T_map_world = start.state.T_map_imu * truth.T_world_imu.Inverse();

  const auto measured = [&](double t_s) {
    ImuSample sample = SampleAt(t_s);
    const double white = 1.0 / std::sqrt(kTumbleStep_s);
    sample.w_imu_radps +=
        truth.gyro_bias + noise.gyro_density * white * test::RandomVector<3>(random);
    sample.f_imu_mps2 +=
        truth.accel_bias + noise.accel_density * white * test::RandomVector<3>(random);
    return sample;
  };
  FilterHistory history(options, start, measured(0.0));
  const auto num_steps = static_cast<int>(std::lround(seconds / kTumbleStep_s));
  for (int i = 1; i <= num_steps; ++i) {
    const double walk = std::sqrt(kTumbleStep_s);
    truth.gyro_bias += noise.gyro_bias_walk_density * walk * test::RandomVector<3>(random);
    truth.accel_bias += noise.accel_bias_walk_density * walk * test::RandomVector<3>(random);
    const double t_s = i * kTumbleStep_s;
    EXPECT_EQ(history.AddImu(measured(t_s)), EventOutcome::kApplied);
    if (i % 5 != 0) continue;
    PoseEvent event = PoseAt(t_s, Vector6::Zero(), kPoseStd);
    event.measurement.T_map_imu =
        T_map_world * TestMotion()(t_s) * ExpSe3(kPoseStd * test::RandomVector<6>(random));
    (void)history.AddPose(StampAt(t_s), event);  // one in a thousand is gated
  }
  const test::MotionState end = test::StateOf(TestMotion(), seconds);
  truth.T_world_imu = end.T_world_imu;
  truth.v_world_imu = end.v_world_imu;
  truth.T_map_imu = T_map_world * end.T_world_imu;
  return {truth, history.head()};
}

TEST(FilterHistory, NeesIsInItsBandWithWhiteNoiseOnAFixedMap) {
  constexpr int kRuns = 60;
  struct Block {
    const char* name;
    int at, size;
    double nees = 0;
  };
  std::vector<Block> blocks = {{"position", kPos, 3},       {"rotation", kRot, 3},
                               {"pose", kPos, 6},           {"velocity", kVel, 3},
                               {"gyro bias", kGyroBias, 3}, {"accel bias", kAccelBias, 3},
                               {"map pose", kMapPose, 6},   {"all", kPos, kMapStart}};
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const TruthRun run = RunWithNoise(seed, 8.0);
    const ErrorVector error = BoxMinus(run.truth, run.estimate.state);
    for (Block& block : blocks) {
      const Eigen::VectorXd part = error.segment(block.at, block.size);
      const Eigen::MatrixXd cov =
          run.estimate.cov.block(block.at, block.at, block.size, block.size);
      block.nees += part.dot(cov.ldlt().solve(part)) / (kRuns * block.size);
    }
  }
  for (const Block& block : blocks) {
    // The tolerance is three standard deviations of the mean over the runs of a chi-square per
    // degree of freedom.
    const double band = 3.0 * std::sqrt(2.0 / (kRuns * block.size));
    EXPECT_NEAR(block.nees, 1.0, band) << block.name;
  }
}

}  // namespace
}  // namespace lio
