// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/moving_start.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "support/smooth_motion.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;
using test::CarMotion;
using test::ImuErrors;
using test::MotionPoint;
using test::NormalVector;
using test::ReadImu;
using test::SmoothMotion;
using test::StampFromZero;
using test::WalkMotion;

constexpr double kDegree = M_PI / 180.0;

SmoothMotion StraightMotion() {
  SmoothMotion motion;
  motion.x = {0.0, 15.0, 0.0, {}};
  motion.roll = {0.05, 0.0, 0.0, {}};
  motion.pitch = {-0.1, 0.0, 0.0, {}};
  motion.yaw = {1.0, 0.0, 0.0, {}};
  return motion;
}

SmoothMotion BrakingMotion() {
  SmoothMotion motion = CarMotion();
  motion.x = {0.0, 14.0, -4.0, {{0.02, 9.0, 0.3}}};
  return motion;
}

// Holds the inputs of the estimator, and the truth.
struct Case {
  std::vector<ImuSample> samples;
  std::vector<MatchedPose> poses;
  NavState truth;  // in world: at the origin, yaw zero
};

struct CaseSetup {
  SmoothMotion motion = CarMotion();
  double window_s = 2.0;
  double rate_hz = 200.0;
  double pose_std_m = 0.02;
  double pose_std_rad = 0.003;
  double gyro_bias_std = 0.005;
  double accel_bias_std = 0.05;
};

Rig TestRig() {
  Rig rig;
  rig.imu.gyro_noise_density = 1e-3;
  rig.imu.accel_noise_density = 1e-2;
  return rig;
}

// The window begins at 0; poses come every 0.1 s from 0.1 s on, in a frame of their own that is
// neither level nor at the origin.
Case MakeCase(const CaseSetup& setup, std::mt19937_64& random) {
  const Rig rig = TestRig();
  Case c;
  ImuErrors errors;
  errors.gyro_density = rig.imu.gyro_noise_density;
  errors.accel_density = rig.imu.accel_noise_density;
  errors.gyro_bias = NormalVector(random, setup.gyro_bias_std);
  errors.accel_bias = NormalVector(random, setup.accel_bias_std);
  c.samples = ReadImu(setup.motion, -0.02, setup.window_s + 0.02, setup.rate_hz, errors, random);
  const Pose T_any_world{ExpSo3(Vector3(0.4, -1.2, 2.0)), Vector3(3, -50, 7)};
  for (int i = 1; i <= std::lround(10 * setup.window_s); ++i) {
    Vector6 noise;
    noise << NormalVector(random, setup.pose_std_m), NormalVector(random, setup.pose_std_rad);
    const Pose truth = T_any_world * setup.motion.At(0.1 * i).T_world_imu;
    c.poses.push_back({StampFromZero(0.1 * i), truth * ExpSe3(noise), 1e-8 * Matrix6::Identity()});
  }
  const MotionPoint start = setup.motion.At(0.0);
  c.truth.T_world_imu.rotation =
      LevelledRotation(start.T_world_imu.rotation.conjugate() * Vector3::UnitZ());
  c.truth.v_world_imu =
      c.truth.T_world_imu.rotation * (start.T_world_imu.rotation.conjugate() * start.v_world);
  c.truth.gyro_bias = errors.gyro_bias;
  c.truth.accel_bias = errors.accel_bias;
  c.truth.T_map_imu = c.truth.T_world_imu;
  return c;
}

struct Named {
  const char* name;
  SmoothMotion motion;
};
std::vector<Named> Motions() {
  return {{"car", CarMotion()},
          {"walk", WalkMotion()},
          {"straight", StraightMotion()},
          {"braking", BrakingMotion()}};
}

double TiltError(const NavState& a, const NavState& b) {
  const Vector3 up_a = a.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  const Vector3 up_b = b.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  return std::asin(std::min(1.0, up_a.cross(up_b).norm()));
}

TEST(MovingStart, TiltAndVelocityAreGoodAfterTwoSeconds) {
  std::mt19937_64 random(1);
  for (const Named& named : Motions()) {
    for (int run = 0; run < 5; ++run) {
      CaseSetup setup;
      setup.motion = named.motion;
      const Case c = MakeCase(setup, random);
      const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
      ASSERT_TRUE(result.start) << named.name << ": " << result.why_not;
      const Estimate& estimate = result.start->estimate;
      EXPECT_LT(TiltError(estimate.state, c.truth), 1.0 * kDegree) << named.name;
      EXPECT_LT((estimate.state.v_world_imu - c.truth.v_world_imu).norm(), 0.2) << named.name;
      EXPECT_LT((estimate.state.gyro_bias - c.truth.gyro_bias).norm(), 6e-3) << named.name;
      EXPECT_NEAR(result.residual_ratio, 1.0, 0.4) << named.name;
    }
  }
}

// The entries are tilt (two), velocity and biases; those that are zero by definition are left out.
TEST(MovingStart, CovarianceIsHonest) {
  std::mt19937_64 random(2);
  constexpr int kRuns = 25;
  for (const Named& named : Motions()) {
    double nees_sum = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      CaseSetup setup;
      setup.motion = named.motion;
      const Case c = MakeCase(setup, random);
      const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
      ASSERT_TRUE(result.start) << named.name << ": " << result.why_not;
      const Estimate& estimate = result.start->estimate;
      const ErrorVector error = BoxMinus(c.truth, estimate.state);
      // The rotation error is taken in world, without yaw.
      const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
      Eigen::Matrix<double, 11, kStateDim> pick = Eigen::Matrix<double, 11, kStateDim>::Zero();
      pick.block<2, 3>(0, kRot) = R.topRows<2>();
      pick.block<9, 9>(2, kVel).setIdentity();
      const Eigen::Matrix<double, 11, 1> e = pick * error;
      const Eigen::Matrix<double, 11, 11> cov = pick * estimate.cov * pick.transpose();
      nees_sum += e.dot(cov.ldlt().solve(e)) / 11.0;
    }
    // 95 % band of 275 degrees of freedom: 0.84 .. 1.17; the widening by the residuals' median only
    // ever widens.
    EXPECT_GT(nees_sum / kRuns, 0.7) << named.name;
    EXPECT_LT(nees_sum / kRuns, 1.2) << named.name;
  }
}

TEST(MovingStart, KnowsThatTiltAndAccelerometerBiasGoTogether) {
  std::mt19937_64 random(3);
  CaseSetup setup;
  setup.motion = StraightMotion();
  const Case c = MakeCase(setup, random);
  const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
  ASSERT_TRUE(result.start) << result.why_not;
  const ErrorMatrix& P = result.start->estimate.cov;
  // The car goes straight on, so a lateral bias looks like a tilt: both stay at the prior, nearly
  // fully correlated.
  EXPECT_NEAR(std::sqrt(P(kAccelBias, kAccelBias)), 0.05, 0.01);
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      largest = std::max(largest,
                         std::abs(P(kRot + i, kAccelBias + j)) /
                             std::sqrt(P(kRot + i, kRot + i) * P(kAccelBias + j, kAccelBias + j)));
    }
  }
  EXPECT_GT(largest, 0.7);
}

TEST(MovingStart, WrongMatchesDoLittleHarm) {
  std::mt19937_64 random(4);
  for (const Named& named : Motions()) {
    CaseSetup setup;
    setup.motion = named.motion;
    Case c = MakeCase(setup, random);
    for (const std::size_t bad : {0u, 7u, 12u}) {
      Vector6 off;
      off << NormalVector(random, 1.0), NormalVector(random, 0.1);
      c.poses[bad].T_any_imu = c.poses[bad].T_any_imu * ExpSe3(off);
    }
    const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
    ASSERT_TRUE(result.start) << named.name << ": " << result.why_not;
    EXPECT_LT(TiltError(result.start->estimate.state, c.truth), 1.0 * kDegree) << named.name;
    EXPECT_LT((result.start->estimate.state.v_world_imu - c.truth.v_world_imu).norm(), 0.2)
        << named.name;
  }
}

TEST(MovingStart, WorksOnRealisticRatesAndWindows) {
  std::mt19937_64 random(5);
  for (const double rate_hz : {100.0, 400.0}) {
    for (const double window_s : {1.5, 3.0}) {
      CaseSetup setup;
      setup.rate_hz = rate_hz;
      setup.window_s = window_s;
      const Case c = MakeCase(setup, random);
      const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
      ASSERT_TRUE(result.start) << result.why_not;
      EXPECT_LT(TiltError(result.start->estimate.state, c.truth), 1.0 * kDegree);
    }
  }
}

TEST(MovingStart, WithoutGravityFindsVelocityAndKeepsRollAndPitchAtZero) {
  std::mt19937_64 random(6);
  CaseSetup setup;
  Case c = MakeCase(setup, random);
  for (ImuSample& sample : c.samples) {
    const double t = SecondsBetween(StampFromZero(0), sample.stamp);
    sample.f_imu_mps2 -=
        setup.motion.At(t).T_world_imu.rotation.conjugate() * Vector3(0, 0, test::kGravity_mps2);
  }
  const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), false);
  ASSERT_TRUE(result.start) << result.why_not;
  EXPECT_EQ(result.start->g_world.norm(), 0.0);
  const MotionPoint start = setup.motion.At(0);
  const Vector3 v_imu = start.T_world_imu.rotation.conjugate() * start.v_world;
  EXPECT_LT((result.start->estimate.state.v_world_imu - v_imu).norm(), 0.2);
  EXPECT_EQ(LogSo3(result.start->estimate.state.T_world_imu.rotation).norm(), 0.0);
  EXPECT_NE(result.start->how.find("without gravity"), std::string::npos);
}

TEST(MovingStart, RefusesAnImuThatIsTurnedAgainstTheLidar) {
  std::mt19937_64 random(8);
  CaseSetup setup;
  Case c = MakeCase(setup, random);
  for (ImuSample& sample : c.samples) {
    sample.w_imu_radps =
        Vector3(-sample.w_imu_radps.y(), sample.w_imu_radps.z(), -sample.w_imu_radps.x());
  }
  const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
  EXPECT_FALSE(result.start);
  EXPECT_NE(result.why_not.find("rig.T_imu_lidar"), std::string::npos) << result.why_not;
}

TEST(MovingStart, RefusesForcesInUnitsOfG) {
  std::mt19937_64 random(9);
  Case c = MakeCase({}, random);
  for (ImuSample& sample : c.samples) sample.f_imu_mps2 /= test::kGravity_mps2;
  const MovingStart result = StartMoving(c.samples, c.poses, StampFromZero(0), TestRig(), true);
  EXPECT_FALSE(result.start);
  EXPECT_NE(result.why_not, "");
}

TEST(MovingStart, SaysWhatIsMissing) {
  std::mt19937_64 random(10);
  const Case c = MakeCase({}, random);
  const auto why = [&](const Case& part) {
    return StartMoving(part.samples, part.poses, StampFromZero(0), TestRig(), true).why_not;
  };
  Case few = c;
  few.poses.resize(5);
  EXPECT_NE(why(few).find("scans"), std::string::npos) << why(few);
  Case gap = c;
  gap.samples.erase(gap.samples.begin() + 100, gap.samples.begin() + 140);
  EXPECT_NE(why(gap).find("inertial samples are missing"), std::string::npos) << why(gap);
  Case cut = c;
  cut.samples.resize(150);
  EXPECT_NE(why(cut).find("inertial samples are missing"), std::string::npos) << why(cut);
}

}  // namespace
}  // namespace lio
