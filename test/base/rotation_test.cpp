// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/rotation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/numeric_jacobian.hpp"

namespace lio {
namespace {

std::vector<Vector3> SampleRotations() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vector3> samples = {Vector3::Zero(), Vector3(1e-8, 0, 0), Vector3(0, -1e-5, 2e-5),
                                  Vector3(0, 0, 3.14)};
  for (const double size : {1e-8, 1e-4, 0.009, 0.011, 1.0}) {
    samples.push_back(size * Vector3{normal(random), normal(random), normal(random)}.normalized());
  }
  return samples;
}

TEST(Rotation, LogInvertsExp) {
  for (const Vector3& phi : SampleRotations()) {
    EXPECT_LT((LogSo3(ExpSo3(phi)) - phi).norm(), 1e-12) << phi.transpose();
  }
}

TEST(Rotation, LogIgnoresTheQuaternionsSign) {
  const Quaternion q = ExpSo3(Vector3(0.3, -0.2, 0.5));
  EXPECT_LT((LogSo3(q) - LogSo3(Quaternion(-q.coeffs()))).norm(), 1e-15);
}

TEST(Rotation, ExpAgreesWithAngleAxis) {
  const Vector3 phi(0.3, -1.2, 0.5);
  const Matrix3 expected = Eigen::AngleAxisd(phi.norm(), phi.normalized()).toRotationMatrix();
  EXPECT_LT((ExpSo3(phi).toRotationMatrix() - expected).norm(), 1e-14);
}

TEST(Rotation, LeftJacobianMatchesDifferences) {
  for (const Vector3& phi : SampleRotations()) {
    const Eigen::MatrixXd numeric = test::NumericJacobian(
        [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
          return LogSo3(ExpSo3(phi + Vector3(d)) * ExpSo3(phi).conjugate());
        },
        Vector3::Zero());
    EXPECT_LT((LeftJacobianSo3(phi) - numeric).norm(), 1e-8) << phi.transpose();
  }
}

TEST(Rotation, RightJacobianMatchesDifferences) {
  const Vector3 phi(0.4, -0.7, 0.1);
  const Eigen::MatrixXd numeric = test::NumericJacobian(
      [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
        return LogSo3(ExpSo3(phi).conjugate() * ExpSo3(phi + Vector3(d)));
      },
      Vector3::Zero());
  EXPECT_LT((RightJacobianSo3(phi) - numeric).norm(), 1e-8);
}

TEST(Rotation, JacobianInversesInvert) {
  for (const Vector3& phi : SampleRotations()) {
    const Matrix3 product = LeftJacobianSo3(phi) * LeftJacobianInverseSo3(phi);
    EXPECT_LT((product - Matrix3::Identity()).norm(), 1e-11) << phi.transpose();
  }
}

TEST(Rotation, YawIsWhereTheXAxisPoints) {
  for (const double yaw_rad : {-3.0, -0.4, 0.0, 1.2, 3.1}) {
    const Quaternion turn = ExpSo3(Vector3(0, 0, yaw_rad));
    EXPECT_NEAR(YawOf(turn * ExpSo3(Vector3(0, 0.3, 0))), yaw_rad, 1e-12);
    EXPECT_NEAR(YawOf(turn * ExpSo3(Vector3(-0.8, 0, 0))), yaw_rad, 1e-12);
  }
}

}  // namespace
}  // namespace lio
