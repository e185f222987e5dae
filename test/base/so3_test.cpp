// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/so3.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "lio/base/rotation.hpp"

namespace lio {
namespace {

using Jet = ceres::Jet<double, 3>;
using JetVector = so3::Vec3<Jet>;

std::vector<Vector3> RotationsForJets() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vector3> samples = {Vector3::Zero(), Vector3(0, 0, 3.1)};
  for (const double size : {1e-9, 1e-5, 1.1e-4, 0.009, 0.011, 0.3, 2.0}) {
    samples.push_back(size * Vector3{normal(random), normal(random), normal(random)}.normalized());
  }
  return samples;
}

JetVector WithDerivatives(const Vector3& value) {
  return {Jet(value.x(), 0), Jet(value.y(), 1), Jet(value.z(), 2)};
}

Vector3 ValuesOf(const JetVector& jets) {
  return {jets.x().a, jets.y().a, jets.z().a};
}

Matrix3 DerivativesOf(const JetVector& jets) {
  Matrix3 derivatives;
  for (int i = 0; i < 3; ++i) derivatives.row(i) = jets[i].v.transpose();
  return derivatives;
}

TEST(So3, ValuesAreThoseOfDoubles) {
  for (const Vector3& phi : RotationsForJets()) {
    const Eigen::Quaternion<Jet> q = so3::Exp<Jet>(WithDerivatives(phi));
    const Quaternion expected = ExpSo3(phi);
    EXPECT_NEAR(q.w().a, expected.w(), 1e-15);
    EXPECT_LT((Vector3(q.x().a, q.y().a, q.z().a) - expected.vec()).norm(), 1e-15);
    EXPECT_LT((ValuesOf(so3::Log<Jet>(q)) - phi).norm(), 1e-12);
  }
}

TEST(So3, LogAfterExpHasTheIdentityAsDerivative) {
  for (const Vector3& phi : RotationsForJets()) {
    const JetVector back = so3::Log<Jet>(so3::Exp<Jet>(WithDerivatives(phi)));
    EXPECT_LT((DerivativesOf(back) - Matrix3::Identity()).norm(), 1e-9) << phi.transpose();
  }
}

// Exp(phi + d) Exp(phi)^-1 = Exp(LeftJacobian(phi) d), whose logarithm is differentiated at d = 0.
TEST(So3, JacobiansAreTheDerivativesOfExp) {
  for (const Vector3& phi : RotationsForJets()) {
    const Eigen::Quaternion<Jet> moved = so3::Exp<Jet>(WithDerivatives(phi));
    const Eigen::Quaternion<Jet> inverse = ExpSo3(phi).conjugate().cast<Jet>();
    const Matrix3 left = DerivativesOf(so3::Log<Jet>(moved * inverse));
    const Matrix3 right = DerivativesOf(so3::Log<Jet>(inverse * moved));
    EXPECT_LT((so3::LeftJacobian<double>(phi) - left).norm(), 1e-9) << phi.transpose();
    EXPECT_LT((so3::LeftJacobian<double>(-phi) - right).norm(), 1e-9) << phi.transpose();
  }
}

TEST(So3, InversesInvertTheJacobians) {
  for (const Vector3& phi : RotationsForJets()) {
    const Matrix3 left = so3::LeftJacobianInverse<double>(phi) * so3::LeftJacobian<double>(phi);
    EXPECT_LT((left - Matrix3::Identity()).norm(), 1e-9) << phi.transpose();
  }
}

TEST(So3, JacobiansHaveFiniteDerivativesAtTheIdentity) {
  const JetVector zero = WithDerivatives(Vector3::Zero());
  const so3::Mat3<Jet> left = so3::LeftJacobian<Jet>(zero);
  const so3::Mat3<Jet> inverse = so3::LeftJacobianInverse<Jet>(zero);
  for (int i = 0; i < 3; ++i) {  // derivatives of I + Hat(phi) / 2 and I - Hat(phi) / 2
    const Matrix3 hat = Hat(Vector3::Unit(i));
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col < 3; ++col) {
        EXPECT_NEAR(left(row, col).v[i], 0.5 * hat(row, col), 1e-15);
        EXPECT_NEAR(inverse(row, col).v[i], -0.5 * hat(row, col), 1e-15);
      }
    }
  }
}

TEST(So3, HatIsTheCrossProduct) {
  const Vector3 a(0.1, -2.0, 0.7);
  const Vector3 b(1.3, 0.2, -0.5);
  EXPECT_EQ(so3::Hat<double>(a) * b, a.cross(b));
}

}  // namespace
}  // namespace lio
