// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/pose.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/numeric_jacobian.hpp"

namespace lio {
namespace {

std::vector<Vector6> SampleTangents() {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<Vector6> samples = {Vector6::Zero()};
  for (const double angle : {1e-8, 1e-3, 0.049, 0.051, 0.7, 2.5}) {
    Vector6 tangent;
    for (double& x : tangent) x = normal(random);
    tangent.tail<3>() = angle * tangent.tail<3>().normalized();
    samples.push_back(tangent);
  }
  return samples;
}

Pose SamplePose() {
  Vector6 tangent;
  tangent << 1.0, -2.0, 0.5, 0.3, -0.4, 0.9;
  return ExpSe3(tangent);
}

TEST(Pose, LogInvertsExp) {
  for (const Vector6& tangent : SampleTangents()) {
    EXPECT_LT((LogSe3(ExpSe3(tangent)) - tangent).norm(), 1e-11) << tangent.transpose();
  }
}

TEST(Pose, InverseComposesToIdentity) {
  const Pose identity = SamplePose() * SamplePose().Inverse();
  EXPECT_LT(identity.translation.norm(), 1e-14);
  EXPECT_LT(LogSo3(identity.rotation).norm(), 1e-14);
}

TEST(Pose, CompositionMapsPointsInTurn) {
  const Pose a = SamplePose();
  const Pose b = ExpSe3(Vector6::Constant(0.4));
  const Vector3 point(1.0, 2.0, 3.0);
  EXPECT_LT(((a * b) * point - a * (b * point)).norm(), 1e-13);
}

TEST(Pose, AdjointMovesAPerturbationToTheLeft) {
  const Pose pose = SamplePose();
  const Vector6 d = 0.3 * Vector6::Ones();
  const Pose right = pose * ExpSe3(d);
  const Pose left = ExpSe3(AdjointSe3(pose) * d) * pose;
  EXPECT_LT(LogSe3(right.Inverse() * left).norm(), 1e-13);
}

TEST(Pose, LeftJacobianMatchesDifferences) {
  for (const Vector6& tangent : SampleTangents()) {
    const Eigen::MatrixXd numeric = test::NumericJacobian(
        [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
          return LogSe3(ExpSe3(tangent + Vector6(d)) * ExpSe3(tangent).Inverse());
        },
        Vector6::Zero());
    EXPECT_LT((LeftJacobianSe3(tangent) - numeric).norm(), 1e-7) << tangent.transpose();
  }
}

TEST(Pose, LeftJacobianInverseInverts) {
  for (const Vector6& tangent : SampleTangents()) {
    const Matrix6 product = LeftJacobianSe3(tangent) * LeftJacobianInverseSe3(tangent);
    EXPECT_LT((product - Matrix6::Identity()).norm(), 1e-10) << tangent.transpose();
  }
}

TEST(Pose, InterpolationHitsBothEndsAndTheMiddle) {
  const Pose a = SamplePose();
  const Pose b = a * ExpSe3(0.2 * Vector6::Unit(5) + Vector6::Unit(0));
  EXPECT_LT(LogSe3(a.Inverse() * Interpolate(a, b, 0.0)).norm(), 1e-13);
  EXPECT_LT(LogSe3(b.Inverse() * Interpolate(a, b, 1.0)).norm(), 1e-13);
  const Pose middle = Interpolate(a, b, 0.5);
  EXPECT_NEAR(LogSo3(a.rotation.conjugate() * middle.rotation).norm(), 0.1, 1e-12);
}

}  // namespace
}  // namespace lio
