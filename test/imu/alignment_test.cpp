// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "imu/alignment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

using test::CarMotion;
using test::MotionPoint;
using test::ReadImu;
using test::StampFromZero;

// Returns two seconds of a car's drive at 400 Hz with 10 poses per second, in a frame that leans.
struct Window {
  explicit Window(double gravity_mps2) {
    errors.gyro_bias = {0.004, -0.002, 0.003};
    errors.accel_bias = {0.05, -0.03, 0.02};
    std::mt19937_64 random(3);
    std::vector<ImuSample> samples = ReadImu(motion, -0.02, 2.02, 400.0, errors, random);
    if (gravity_mps2 == 0) TakeGravityOut(samples);
    for (int i = 0; i <= 20; ++i) {
      const MotionPoint point = motion.At(0.1 * i);
      const Pose T_any_imu = T_any_world * point.T_world_imu;
      truth.states.push_back(
          {T_any_imu.rotation, T_any_imu.translation, T_any_world.rotation * point.v_world});
      if (i == 0) continue;
      MatchedPose pose;
      pose.stamp = StampFromZero(0.1 * i);
      pose.T_any_imu = T_any_imu;
      pose.cov.diagonal() << Vector3::Constant(0.02 * 0.02), Vector3::Constant(0.003 * 0.003);
      poses.push_back(pose);
      const ProcessNoise noise{1e-3, 1e-2, 0, 0};
      terms.motions.push_back(
          Preintegrate(samples, StampFromZero(0.1 * (i - 1)), StampFromZero(0.1 * i), {}, noise));
    }
    truth.biases = {errors.gyro_bias, errors.accel_bias};
    truth.up_any = T_any_world.rotation * Vector3::UnitZ();
    terms.poses = poses;
    terms.gravity_mps2 = gravity_mps2;
    terms.gyro_bias_std_radps = 0.02;
    terms.accel_bias_std_mps2 = 0.2;
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void TakeGravityOut(std::vector<ImuSample>& samples) const {
    for (ImuSample& sample : samples) {
      const Pose T_world_imu =
          motion.At(SecondsBetween(StampFromZero(0), sample.stamp)).T_world_imu;
      sample.f_imu_mps2 -= T_world_imu.rotation.conjugate() * Vector3(0, 0, test::kGravity_mps2);
    }
  }
  // The start is degrees and metres per second off, and the biases are unknown.
  Alignment Guess() const {
    Alignment guess = truth;
    for (WindowState& state : guess.states) {
      state.R_any_imu = state.R_any_imu * ExpSo3(Vector3(0.05, -0.04, 0.06));
      state.p_any_imu += Vector3(0.3, -0.2, 0.4);
      state.v_any_imu += Vector3(-1, 1.5, 0.5);
    }
    guess.up_any = ExpSo3(Vector3(0.1, -0.1, 0.05)) * guess.up_any;
    guess.biases = {};
    if (terms.gravity_mps2 == 0) guess.up_any = Vector3::UnitX();
    return guess;
  }

  test::SmoothMotion motion = CarMotion();
  Pose T_any_world{ExpSo3(Vector3(0.4, -1.2, 2.0)), Vector3(3, -50, 7)};
  test::ImuErrors errors;
  Alignment truth;
  std::vector<MatchedPose> poses;
  AlignmentTerms terms;
};

double RotationError(const WindowState& a, const WindowState& b) {
  return LogSo3(a.R_any_imu.conjugate() * b.R_any_imu).norm();
}

TEST(Alignment, ExactPosesGiveBackTheMotion) {
  const Window window(test::kGravity_mps2);
  const AlignmentResult result = Align(window.terms, window.Guess());
  ASSERT_TRUE(result.converged);
  ASSERT_EQ(result.solution.states.size(), 21u);
  for (std::size_t i = 0; i < 21; ++i) {
    const WindowState& state = result.solution.states[i];
    EXPECT_LT(RotationError(state, window.truth.states[i]), 1e-3) << i;
    EXPECT_LT((state.p_any_imu - window.truth.states[i].p_any_imu).norm(), 5e-3) << i;
    EXPECT_LT((state.v_any_imu - window.truth.states[i].v_any_imu).norm(), 0.02) << i;
  }
  EXPECT_LT((result.solution.biases.gyro - window.errors.gyro_bias).norm(), 1e-3);
  EXPECT_NEAR(result.solution.up_any.norm(), 1.0, 1e-9);
  // The car's motion barely separates tilt and accelerometer bias; their sum is more certain.
  EXPECT_LT((result.solution.up_any - window.truth.up_any).norm(), 1e-2);
  const auto force_at_rest = [](const Alignment& at) -> Vector3 {
    return at.states[0].R_any_imu.conjugate() * (test::kGravity_mps2 * at.up_any) + at.biases.accel;
  };
  EXPECT_LT((force_at_rest(result.solution) - force_at_rest(window.truth)).norm(), 0.02);
  ASSERT_EQ(result.pose_residual_sq.size(), 20u);
  for (const double square : result.pose_residual_sq) EXPECT_LT(square, 0.1);
}

TEST(Alignment, WithoutGravityTheVerticalStaysAsItWasGuessed) {
  const Window window(0.0);
  const AlignmentResult result = Align(window.terms, window.Guess());
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(result.solution.up_any, Vector3::UnitX());
  EXPECT_LT((result.solution.biases.accel - window.errors.accel_bias).norm(), 0.02);
  EXPECT_LT((result.solution.states[0].v_any_imu - window.truth.states[0].v_any_imu).norm(), 0.02);
  EXPECT_TRUE((result.cov.bottomRows<3>().array() == 0).all());
}

TEST(Alignment, OneWrongPosePullsLittleAndHasALargeResidual) {
  Window window(test::kGravity_mps2);
  window.poses[9].T_any_imu.translation += Vector3(3, 0, 0);
  window.terms.poses = window.poses;
  const AlignmentResult result = Align(window.terms, window.Guess());
  ASSERT_TRUE(result.converged);
  EXPECT_LT((result.solution.states[10].p_any_imu - window.truth.states[10].p_any_imu).norm(), 0.1);
  // 3 m at a standard deviation of 2 cm: 150 sigmas, but for what the state gives way.
  EXPECT_GT(result.pose_residual_sq[9], 140.0 * 140.0);
  EXPECT_LT(result.pose_residual_sq[8], 20.0);
  EXPECT_LT(result.pose_residual_sq[10], 20.0);
}

// The covariance falls to a quarter when every standard deviation is halved.
TEST(Alignment, CovarianceFollowsTheNoise) {
  Window window(test::kGravity_mps2);
  const AlignmentResult plain = Align(window.terms, window.truth);
  for (MatchedPose& pose : window.poses) pose.cov *= 0.25;
  for (Preintegration& motion : window.terms.motions) motion.cov *= 0.25;
  window.terms.poses = window.poses;
  window.terms.gyro_bias_std_radps *= 0.5;
  window.terms.accel_bias_std_mps2 *= 0.5;
  const AlignmentResult half = Align(window.terms, window.truth);
  ASSERT_TRUE(plain.converged && half.converged);
  const Eigen::Matrix<double, 15, 1> ratio =
      half.cov.diagonal().cwiseQuotient(plain.cov.diagonal());
  EXPECT_LT((ratio.array() - 0.25).abs().maxCoeff(), 0.01) << ratio.transpose();
}

TEST(Alignment, CovarianceIsSymmetricPositiveAndFlatAlongTheVertical) {
  const Window window(test::kGravity_mps2);
  const AlignmentResult result = Align(window.terms, window.Guess());
  EXPECT_LT((result.cov - result.cov.transpose()).cwiseAbs().maxCoeff(),
            1e-9 * result.cov.cwiseAbs().maxCoeff());
  const Eigen::SelfAdjointEigenSolver<AlignedCov> solver(result.cov);
  EXPECT_GT(solver.eigenvalues()(0), -1e-12);
  EXPECT_GT(solver.eigenvalues()(1), 1e-12);  // all but the length of up_any
  const Vector3 along = result.cov.bottomRightCorner<3, 3>() * result.solution.up_any;
  EXPECT_LT(along.norm(), 1e-9);
  // Biases are known better than before.
  EXPECT_LT(std::sqrt(result.cov(kAlignedBiases, kAlignedBiases)), 0.02);
  EXPECT_LT(std::sqrt(result.cov(kAlignedBiases + 3, kAlignedBiases + 3)), 0.2);
}

}  // namespace
}  // namespace lio
