// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/start_state.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <stdexcept>
#include <tuple>

#include "support/motion.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;
using test::StampAt;

constexpr double kSamplePeriod_s = 0.01;

struct Rest {
  Quaternion R_world_imu = Quaternion::Identity();
  Vector3 gyro_bias = Vector3::Zero();
  Vector3 accel_bias = Vector3::Zero();
  Vector3 g_world = test::kGravity;
};

// Returns a second of an IMU at rest, with noise as in the rig.
std::vector<ImuSample> StandStill(const Rest& rest, const Rig& rig, std::mt19937_64& random) {
  const double white = 1.0 / std::sqrt(kSamplePeriod_s);
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 100; ++i) {
    ImuSample sample;
    sample.stamp = StampAt(i * kSamplePeriod_s);
    sample.w_imu_radps =
        rest.gyro_bias + rig.imu.gyro_noise_density * white * test::RandomVector<3>(random);
    sample.f_imu_mps2 = rest.R_world_imu.conjugate() * -rest.g_world + rest.accel_bias +
                        rig.imu.accel_noise_density * white * test::RandomVector<3>(random);
    samples.push_back(sample);
  }
  return samples;
}

Quaternion Tilted(double roll_rad, double pitch_rad) {
  return ExpSo3(Vector3(0, pitch_rad, 0)) * ExpSo3(Vector3(roll_rad, 0, 0));
}

TEST(StartState, GravityIsFoundInTheReadingUnlessTheRigSays) {
  Rig rig;
  ImuStatistics present;
  present.mean_f_mps2 = Vector3(0.3, 0, 9.7);
  ImuStatistics removed;
  removed.mean_f_mps2 = Vector3(0.3, 0, -0.1);
  EXPECT_TRUE(GravityPresent(present, rig));
  EXPECT_FALSE(GravityPresent(removed, rig));
  rig.imu.gravity = GravityInput::kRemoved;
  EXPECT_FALSE(GravityPresent(present, rig));
  rig.imu.gravity = GravityInput::kPresent;
  EXPECT_TRUE(GravityPresent(removed, rig));
}

TEST(StartState, RestLevelsTheWorldAndSeedsTheGyroBias) {
  std::mt19937_64 random(1);
  const Rig rig;
  Rest rest;
  rest.R_world_imu = Tilted(0.2, -0.1);
  rest.gyro_bias = Vector3(0.01, -0.02, 0.005);
  const StartState start = StartAtRest(StandStill(rest, rig, random), StampAt(1.0), rig);
  const NavState& state = start.estimate.state;
  EXPECT_EQ(start.estimate.stamp, StampAt(1.0));
  const Vector3 up = state.T_world_imu.rotation * (rest.R_world_imu.conjugate() * Vector3::UnitZ());
  EXPECT_GT(up.z(), 0.99999);
  const Vector3 forward = state.T_world_imu.rotation * Vector3::UnitX();
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.0, 1e-9) << "yaw is zero by definition";
  EXPECT_LT((state.gyro_bias - rest.gyro_bias).norm(), 0.004);
  EXPECT_EQ(state.T_world_imu.translation, Vector3::Zero());
  EXPECT_LT(state.v_world_imu.norm(), 1e-9);
  EXPECT_EQ(start.g_world, Vector3(0, 0, -rig.gravity_mps2));
  EXPECT_NE(start.how.find("at rest"), std::string::npos);
  EXPECT_EQ(LogSe3(state.T_map_imu.Inverse() * state.T_world_imu).norm(), 0.0);
}

TEST(StartState, RestIsUnsureByTheMotionThatScansShowMeanwhile) {
  std::mt19937_64 random(1);
  const Rig rig;
  Rig quiet;  // noise is turned along with the forces, and looks like a velocity
  quiet.imu.gyro_noise_density = 0.0;
  const std::vector<ImuSample> samples = StandStill({}, quiet, random);
  const auto cov_with = [&](const ShownMotion& shown) {
    return StartAtRest(samples, StampAt(1.0), rig, shown).estimate.cov;
  };
  const ErrorMatrix none = cov_with({});
  const ErrorMatrix shifted = cov_with({.shift_m = 0.3});
  const ErrorMatrix turned = cov_with({.turn_rad = 0.003});
  EXPECT_NEAR(std::sqrt(none(kVel, kVel)), 0.01, 1e-4);
  EXPECT_NEAR(std::sqrt(shifted(kVel, kVel)), 0.3, 0.01);
  EXPECT_EQ(shifted(kGyroBias, kGyroBias), none(kGyroBias, kGyroBias));
  EXPECT_GT(turned(kGyroBias, kGyroBias), none(kGyroBias, kGyroBias));
  // The rig's own 0.005 rad/s and the measured 0.003 together.
  EXPECT_NEAR(std::sqrt(turned(kGyroBias, kGyroBias)), 0.0026, 3e-4);
  EXPECT_NEAR(turned(kVel, kVel), none(kVel, kVel), 1e-12);
}

// In a meadow scans cannot tell by how much a walker turned who sways while standing, and the mean
// rate of that second is no bias of the gyro.
TEST(StartState, ASwayingRestIsUnsureByTheTurnThatScansCannotTell) {
  const Rig rig;
  constexpr double kRate_radps = 0.02;
  const test::Motion sway = [](double t_s) {
    return Pose{ExpSo3(Vector3(kRate_radps * t_s, 0.02 * std::sin(2.0 * t_s), 0)), Vector3::Zero()};
  };
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 100; ++i) samples.push_back(test::ExactSample(sway, kSamplePeriod_s * i));
  const auto sigmas_off = [&](const ShownMotion& shown) {
    const Estimate estimate = StartAtRest(samples, StampAt(1.0), rig, shown).estimate;
    return std::abs(estimate.state.gyro_bias.x()) / std::sqrt(estimate.cov(kGyroBias, kGyroBias));
  };
  EXPECT_LT(sigmas_off({.turn_std_rad = 0.03}), 1.0);
  EXPECT_GT(sigmas_off({.turn_std_rad = 1e-4}), 5.0) << "the scans tell that it has not turned";
}

TEST(StartState, WhatScansCannotTellIsNoTurnOfABodyThatStands) {
  std::mt19937_64 random(1);
  const Rig rig;
  const std::vector<ImuSample> samples = StandStill({}, rig, random);
  const auto bias_var = [&](const ShownMotion& shown) {
    return StartAtRest(samples, StampAt(1.0), rig, shown).estimate.cov(kGyroBias, kGyroBias);
  };
  EXPECT_EQ(bias_var({.turn_std_rad = 0.03}), bias_var({}));
}

TEST(StartState, UpsideDownAndOnItsSideAreLevelledToo) {
  std::mt19937_64 random(2);
  const Rig rig;
  for (const double roll_rad : {M_PI / 2, M_PI - 0.01, M_PI}) {
    Rest rest;
    rest.R_world_imu = Tilted(roll_rad, 0.05);
    const StartState start = StartAtRest(StandStill(rest, rig, random), StampAt(1.0), rig);
    const Vector3 up = start.estimate.state.T_world_imu.rotation *
                       (rest.R_world_imu.conjugate() * Vector3::UnitZ());
    EXPECT_GT(up.z(), 0.999) << roll_rad;
    EXPECT_TRUE(start.estimate.cov.allFinite());
  }
}

TEST(StartState, GravityFreeReadingIsNoTilt) {
  std::mt19937_64 random(3);
  const Rig rig;
  Rest rest;
  rest.g_world = Vector3::Zero();
  rest.accel_bias = Vector3(0.02, 0.03, -0.01);
  const StartState start = StartAtRest(StandStill(rest, rig, random), StampAt(1.0), rig);
  EXPECT_EQ(start.g_world, Vector3::Zero());
  EXPECT_LT(LogSo3(start.estimate.state.T_world_imu.rotation).norm(), 1e-9);
  EXPECT_LT((start.estimate.state.accel_bias - rest.accel_bias).norm(), 0.01);
  EXPECT_NE(start.how.find("without gravity"), std::string::npos);
}

// Biases are drawn from the rig's own spread: errors must agree with the covariance, including the
// correlation of tilt and accelerometer bias.
TEST(StartState, CovarianceAtRestAgreesWithMonteCarlo) {
  constexpr int kRuns = 300;
  std::mt19937_64 random(4);
  Rig rig;
  std::vector<int> rows = {kRot, kRot + 1};  // level enough that yaw, zero by definition, is z
  for (int i = kGyroBias; i < kGyroBias + 6; ++i) rows.push_back(i);
  double nees = 0;
  double tilt_sq = 0;
  double predicted_tilt_sq = 0;
  for (int run = 0; run < kRuns; ++run) {
    Rest rest;
    rest.gyro_bias = rig.imu.gyro_bias_std_radps * test::RandomVector<3>(random);
    rest.accel_bias = rig.imu.accel_bias_std_mps2 * test::RandomVector<3>(random);
    const StartState start = StartAtRest(StandStill(rest, rig, random), StampAt(1.0), rig);
    NavState truth;
    truth.gyro_bias = rest.gyro_bias;
    truth.accel_bias = rest.accel_bias;
    const ErrorVector error = BoxMinus(truth, start.estimate.state);
    const Eigen::VectorXd part = error(rows);
    const Eigen::MatrixXd cov = start.estimate.cov(rows, rows);
    nees += part.dot(cov.ldlt().solve(part)) / kRuns;
    tilt_sq += part.head<2>().squaredNorm() / kRuns;
    predicted_tilt_sq += (cov(0, 0) + cov(1, 1)) / kRuns;
  }
  const auto dof = static_cast<double>(rows.size());
  // Gravity's strength is known exactly here but modelled as uncertain, so a little below is right.
  EXPECT_LT(nees, dof + 3 * std::sqrt(2 * dof / kRuns));
  EXPECT_GT(nees, 0.8 * dof);
  EXPECT_NEAR(tilt_sq / predicted_tilt_sq, 1.0, 3 * std::sqrt(1.0 / kRuns));
}

// A body that sways by some degrees while it stands: the tilt is that of the end, as unsure as the
// gyro's bias lets it, and errs the way that bias does.
TEST(StartState, CovarianceOfASwayingRestAgreesWithMonteCarlo) {
  constexpr int kRuns = 300;
  std::mt19937_64 random(6);
  const Rig rig;
  const double white = 1.0 / std::sqrt(kSamplePeriod_s);
  const std::vector<int> rows = {kRot, kRot + 1, kGyroBias, kGyroBias + 1};
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const double rate_radps = test::RandomVector<1>(random).x() * 0.05;
    const test::Motion motion = [&](double t_s) {
      return Pose{ExpSo3(Vector3(rate_radps * (t_s - 1.0), 0.02 * std::sin(t_s - 1.0), 0)),
                  Vector3::Zero()};
    };
    NavState truth;
    truth.T_world_imu = motion(1.0);
    truth.gyro_bias = rig.imu.gyro_bias_std_radps * test::RandomVector<3>(random);
    truth.accel_bias = rig.imu.accel_bias_std_mps2 * test::RandomVector<3>(random);
    std::vector<ImuSample> samples;
    for (int i = 0; i <= 100; ++i) {
      ImuSample sample = test::ExactSample(motion, kSamplePeriod_s * i);
      sample.w_imu_radps +=
          truth.gyro_bias + rig.imu.gyro_noise_density * white * test::RandomVector<3>(random);
      sample.f_imu_mps2 +=
          truth.accel_bias + rig.imu.accel_noise_density * white * test::RandomVector<3>(random);
      samples.push_back(sample);
    }
    const ShownMotion shown{.turn_rad = LogSo3(motion(0.0).rotation).norm()};
    const StartState start = StartAtRest(samples, StampAt(1.0), rig, shown);
    const Eigen::VectorXd part = BoxMinus(truth, start.estimate.state)(rows);
    const Eigen::MatrixXd cov = start.estimate.cov(rows, rows);
    nees += part.dot(cov.ldlt().solve(part)) / kRuns;
  }
  // Below the number of rows, since the turn counts as unknown by its size along each axis.
  EXPECT_LT(nees, 4.0 + 3 * std::sqrt(8.0 / kRuns));
  EXPECT_GT(nees, 1.5);
}

LastFix Passed() {
  LastFix point;
  point.stamp = StampAt(1.0);
  point.T_world_imu = {ExpSo3(Vector3(0.02, 0, 1.0)), Vector3(30, 20, 1)};
  point.v_world_imu = Vector3(2, 0, 0);
  point.T_map_imu = {ExpSo3(Vector3(0.05, 0.01, 0.9)), Vector3(31, 19, 0)};
  point.pose_cov.diagonal() << 0.04, 0.09, 0.01, 1e-6, 1e-6, 4e-6;
  return point;
}

// The initialization is repeated half a second later, at its own origin.
Estimate StartedAnew() {
  Estimate estimate;
  estimate.stamp = StampAt(1.5);
  estimate.state.T_world_imu.rotation = ExpSo3(Vector3(0.03, 0.01, 0));
  estimate.state.T_map_imu = estimate.state.T_world_imu;
  estimate.state.v_world_imu = Vector3(1, 0, 0);
  return estimate;
}

TEST(PlaceInWorld, WorldAndMapGoOnByTheSameMotion) {
  const LastFix earlier = Passed();
  Estimate estimate = StartedAnew();
  PlaceInWorld(earlier, true, estimate);
  const NavState& state = estimate.state;
  const Vector3 v_now(std::cos(1.0), std::sin(1.0), 0);
  const Vector3 expected = Vector3(30, 20, 1) + 0.25 * (earlier.v_world_imu + v_now);
  EXPECT_LT((state.v_world_imu - v_now).norm(), 1e-3);
  EXPECT_LT((state.T_world_imu.translation - expected).norm(), 1e-3);
  const Vector3 up = state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  const Vector3 up_of_start =
      StartedAnew().state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  EXPECT_LT((up - up_of_start).norm(), 1e-12) << "level as the start found it";
  const Pose in_world = earlier.T_world_imu.Inverse() * state.T_world_imu;
  const Pose in_map = earlier.T_map_imu.Inverse() * state.T_map_imu;
  EXPECT_LT(LogSe3(in_world.Inverse() * in_map).norm(), 1e-12);
}

TEST(PlaceInWorld, WithoutGravityTheAttitudeStays) {
  Estimate estimate = StartedAnew();
  PlaceInWorld(Passed(), false, estimate);
  const Quaternion& rotation = estimate.state.T_world_imu.rotation;
  EXPECT_LT(LogSo3(rotation.conjugate() * Passed().T_world_imu.rotation).norm(), 1e-12);
  EXPECT_LT(
      LogSo3(estimate.state.T_map_imu.rotation.conjugate() * Passed().T_map_imu.rotation).norm(),
      1e-12);
}

TEST(PlaceInWorld, PositionAndYawAreAsUnsureAsTheyWereAndMore) {
  const LastFix earlier = Passed();
  Estimate estimate = StartedAnew();
  PlaceInWorld(earlier, true, estimate);
  const double coasted_m = 0.25 * (estimate.state.v_world_imu - earlier.v_world_imu).norm();
  EXPECT_NEAR(estimate.cov(kPos, kPos), 0.04 + 0.25 + coasted_m * coasted_m, 1e-12);
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 rotation_cov = R * estimate.cov.block<3, 3>(kRot, kRot) * R.transpose();
  EXPECT_NEAR(rotation_cov(2, 2), 4e-6 + 0.0025, 1e-7);
  EXPECT_NEAR(rotation_cov(0, 0), 0.0, 1e-12) << "its tilt is the start's";
  // A yaw error turns the velocity, too: in imu it is as certain as the start has it.
  ErrorVector yaw = ErrorVector::Zero();
  yaw.segment<3>(kRot) = R.transpose() * Vector3::UnitZ() * 1e-6;
  yaw.segment<3>(kVel) = Vector3::UnitZ().cross(estimate.state.v_world_imu) * 1e-6;
  const NavState turned = BoxPlus(estimate.state, yaw);
  EXPECT_LT((turned.T_world_imu.rotation.conjugate() * turned.v_world_imu -
             estimate.state.T_world_imu.rotation.conjugate() * estimate.state.v_world_imu)
                .norm(),
            1e-11);
  EXPECT_LT((estimate.cov.block<3, 3>(kVel, kRot) -
             rotation_cov(2, 2) * 1e12 * yaw.segment<3>(kVel) * yaw.segment<3>(kRot).transpose())
                .norm(),
            1e-12);
}

TEST(Level, TurnsAPointsWorldAndLeavesYawPositionAndMap) {
  LastFix point = Passed();
  const Quaternion level = Tilted(0.1, -0.05);
  Level(level, point);
  const Vector3 up = point.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  EXPECT_LT((up - level.conjugate() * Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(point.T_world_imu.translation, Passed().T_world_imu.translation);
  EXPECT_EQ(point.T_map_imu.rotation.coeffs(), Passed().T_map_imu.rotation.coeffs());
  EXPECT_LT((point.T_world_imu.rotation.conjugate() * point.v_world_imu -
             Passed().T_world_imu.rotation.conjugate() * Passed().v_world_imu)
                .norm(),
            1e-12)
      << "the same in imu";
  const Vector3 forward = point.T_world_imu.rotation * Vector3::UnitX();
  const Vector3 forward_before = Passed().T_world_imu.rotation * Vector3::UnitX();
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()),
              std::atan2(forward_before.y(), forward_before.x()), 1e-9);
}

TEST(StartState, RefusesToStartWithoutSamples) {
  EXPECT_THROW(std::ignore = StartAtRest({}, StampAt(0.0), Rig{}), std::invalid_argument);
}

}  // namespace
}  // namespace lio
