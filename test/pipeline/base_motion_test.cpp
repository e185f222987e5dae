// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/base_motion.hpp"

#include <gtest/gtest.h>

#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::NumericJacobian;

const Vector3 kGyroReading(0.3, -0.8, 0.5);

NavOutput NavOf(const NavState& state) {
  NavOutput nav;
  nav.T_world_imu = state.T_world_imu;
  nav.v_world_imu_mps = state.v_world_imu;
  nav.w_imu_radps = kGyroReading - state.gyro_bias;
  nav.T_map_imu = state.T_map_imu;
  return nav;
}

struct Case {
  NavState state;
  Pose T_base_imu;
  ErrorMatrix cov;

  explicit Case(std::mt19937_64& random)
      : state(test::RandomState(random)),
        T_base_imu(ExpSe3(test::RandomVector<6>(random))),
        cov(test::RandomCovariance<kStateDim>(random, 0.1)) {}

  BaseMotion Motion(const NavState& of, double rate_var = 0.0) const {
    NavOutput nav = NavOf(of);
    nav.map_pose_cov = cov.block<6, 6>(kMapPose, kMapPose);
    return MoveToBase(nav, cov.topLeftCorner<kAccelBias, kAccelBias>(), rate_var, T_base_imu);
  }

  // Returns the derivative by errors of the state of `minus(motion, nominal motion)`.
  template <class Minus>
  Eigen::MatrixXd Jacobian(Minus minus) const {
    const auto f = [&](const Eigen::VectorXd& error) {
      return Eigen::VectorXd(minus(Motion(BoxPlus(state, error)), Motion(state)));
    };
    return NumericJacobian(f, Eigen::VectorXd::Zero(kStateDim));
  }
};

TEST(BaseMotion, CovariancesAreThoseOfNumericDerivatives) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const Case c(random);
    const BaseMotion motion = c.Motion(c.state);
    const Eigen::MatrixXd pose = c.Jacobian([](const BaseMotion& a, const BaseMotion& b) {
      Vector6 d;
      d << a.T_world_base.translation - b.T_world_base.translation,
          LogSo3(b.T_world_base.rotation.conjugate() * a.T_world_base.rotation);
      return d;
    });
    EXPECT_LT((pose * c.cov * pose.transpose() - motion.pose_cov).norm(), 1e-8);
    const Eigen::MatrixXd velocity = c.Jacobian([](const BaseMotion& a, const BaseMotion& b) {
      return Vector3(a.v_world_base_mps - b.v_world_base_mps);
    });
    EXPECT_LT((velocity * c.cov * velocity.transpose() - motion.velocity_cov).norm(), 1e-8);
    const Eigen::MatrixXd map = c.Jacobian([](const BaseMotion& a, const BaseMotion& b) {
      return LogSe3(b.T_map_base.Inverse() * a.T_map_base);
    });
    EXPECT_LT((map * c.cov * map.transpose() - motion.map_pose_cov).norm(), 1e-8);
  }
}

TEST(BaseMotion, VelocityIsThePositionsDerivative) {
  std::mt19937_64 random(4);
  const Case c(random);
  const Vector3 w_imu = kGyroReading - c.state.gyro_bias;
  constexpr double kStep_s = 1e-4;
  const auto position_after = [&](double dt) {
    NavState later = c.state;
    later.T_world_imu.translation += dt * c.state.v_world_imu;
    later.T_world_imu.rotation = c.state.T_world_imu.rotation * ExpSo3(dt * w_imu);
    return c.Motion(later).T_world_base.translation;
  };
  const Vector3 derivative = (position_after(kStep_s) - position_after(-kStep_s)) / (2.0 * kStep_s);
  EXPECT_LT((c.Motion(c.state).v_world_base_mps - derivative).norm(), 1e-6);
}

TEST(BaseMotion, OfTheImuItselfIsTheImus) {
  std::mt19937_64 random(5);
  Case c(random);
  c.T_base_imu = Pose::Identity();
  const BaseMotion motion = c.Motion(c.state, 7.0);
  EXPECT_LT((motion.pose_cov - c.cov.topLeftCorner<6, 6>()).norm(), 1e-12);
  EXPECT_LT((motion.velocity_cov - c.cov.block<3, 3>(kVel, kVel)).norm(), 1e-12);
  EXPECT_EQ(motion.w_base_radps, NavOf(c.state).w_imu_radps);
  EXPECT_LT((motion.v_world_base_mps - c.state.v_world_imu).norm(), 1e-12);
}

TEST(BaseMotion, NoiseOfTheRateShakesTheVelocityAcrossTheLever) {
  NavOutput nav;
  const Pose T_base_imu{Quaternion::Identity(), Vector3(2, 0, 0)};  // imu 2 m ahead of base
  const BaseMotion motion = MoveToBase(nav, NavCov::Zero(), 0.01, T_base_imu);
  const Vector3 variances(0.0, 0.04, 0.04);
  EXPECT_LT((motion.velocity_cov - Matrix3(variances.asDiagonal())).norm(), 1e-12);
}

}  // namespace
}  // namespace lio
