// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/pose_manifold.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

// Returns identity, nearly identity, small and large rotations.
std::vector<Pose> ExactAnglePoses() {
  std::mt19937_64 random(3);
  std::vector<Pose> poses{Pose::Identity(), {ExpSo3(Vector3(1e-9, -2e-9, 1e-9)), Vector3::Zero()}};
  for (const double angle : {1e-6, 1e-3, 0.1, 1.0, 1.8}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 turn = angle * test::RandomVector<3>(random).normalized();
      poses.push_back({ExpSo3(turn), 20.0 * test::RandomVector<3>(random)});
    }
  }
  return poses;
}

TEST(PoseManifold, BlocksAreQuaternionXYZWThenTranslation) {
  const Pose pose{Quaternion(0.5, -0.5, 0.5, 0.5), {1, 2, 3}};  // w first, as Eigen has it
  EXPECT_EQ(ToBlock(pose), (PoseBlock{-0.5, 0.5, 0.5, 0.5, 1, 2, 3}));
  const PoseBlock longer{0, 0, 0, 2, 4, 5, 6};
  EXPECT_EQ(ToPose(longer.data()).rotation.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(ToPose(longer.data()).translation, Vector3(4, 5, 6));
  EXPECT_EQ(PoseManifold().AmbientSize(), 7);
  EXPECT_EQ(PoseManifold().TangentSize(), 6);
}

// One metre ahead of a body that faces along y is one metre along y.
TEST(PoseManifold, StepsAreInTheBodysAxesTranslationFirst) {
  const PoseBlock x = ToBlock({ExpSo3(Vector3(0, 0, M_PI / 2)), {10, 0, 0}});
  const double delta[] = {1, 0, 0, 0, 0, 0};
  PoseBlock y;
  ASSERT_TRUE(PoseManifold().Plus(x.data(), delta, y.data()));
  EXPECT_LT((ToPose(y.data()).translation - Vector3(10, 1, 0)).norm(), 1e-12);
}

TEST(PoseManifold, IsConsistent) {
  const PoseManifold manifold;
  std::mt19937_64 random(9);
  for (const Pose& pose : ExactAnglePoses()) {
    const PoseBlock x = ToBlock(pose);
    Vector6 delta;
    delta << test::RandomVector<3>(random), 0.4 * test::RandomVector<3>(random);
    PoseBlock y;
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), y.data()));
    Vector6 back;
    ASSERT_TRUE(manifold.Minus(y.data(), x.data(), back.data()));
    EXPECT_LE((back - delta).norm(), 1e-12);

    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
    ASSERT_TRUE(manifold.PlusJacobian(x.data(), plus.data()));
    ASSERT_TRUE(manifold.MinusJacobian(x.data(), minus.data()));
    EXPECT_LE((minus * plus - Matrix6::Identity()).norm(), 1e-12);
    const auto f = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      PoseBlock moved;
      manifold.Plus(x.data(), d.data(), moved.data());
      return Eigen::Map<const Eigen::Matrix<double, 7, 1>>(moved.data());
    };
    const Eigen::MatrixXd numeric = test::NumericJacobian(f, Eigen::VectorXd::Zero(6), 1e-6);
    EXPECT_LE((plus - numeric).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace lio
