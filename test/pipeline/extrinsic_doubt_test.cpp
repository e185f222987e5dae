// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/extrinsic_doubt.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lio {
namespace {

// The imu is mounted with a tilt; the body has driven on and turned.
const Quaternion kTilt = ExpSo3(Vector3(0.3, -0.2, 0.0));
const Pose kNow{ExpSo3(Vector3(0.0, 0.0, 1.2)) * kTilt, Vector3(80.0, 30.0, 2.0)};
const Vector3 kVelocity(3.0, 8.0, 0.0);
const ExtrinsicStd kStd{Vector3(2e-3, 3e-3, 4e-3), Vector3(0.02, 0.03, 0.01)};

// The position by an extrinsic with these errors, of which gravity leaves the part of the rotation
// about the vertical.
Vector3 PositionBy(const Vector3& lever_m, const Vector3& rotation_rad) {
  const Vector3 up_imu = kTilt.conjugate() * Vector3::UnitZ();
  const Pose error{ExpSo3(up_imu * up_imu.dot(rotation_rad)), lever_m};
  const Pose start{kTilt, Vector3::Zero()};
  return (start * error.Inverse() * start.Inverse() * kNow * error).translation;
}

Matrix3 SampledPositionCov() {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3{normal(random), normal(random), normal(random)}; };
  Matrix3 cov = Matrix3::Zero();
  constexpr int kNumDraws = 20000;
  for (int i = 0; i < kNumDraws; ++i) {
    const Vector3 lever_m = kStd.lever_m.cwiseProduct(draw());
    const Vector3 rotation_rad = kStd.rotation_rad.cwiseProduct(draw());
    const Vector3 off = PositionBy(lever_m, rotation_rad) - kNow.translation;
    cov += off * off.transpose() / kNumDraws;
  }
  return cov;
}

TEST(ExtrinsicDoubt, IsTheCovarianceOfPathsByWrongExtrinsics) {
  WorldEstimate estimate;
  estimate.T_world_imu = kNow;
  estimate.v_world_imu = kVelocity;
  AddExtrinsicDoubt(kStd, estimate);
  const Matrix3 sampled = SampledPositionCov();
  EXPECT_LT((estimate.cov.block<3, 3>(kPos, kPos) - sampled).norm(), 0.03 * sampled.norm());
  EXPECT_EQ((estimate.cov.block<3, 3>(kRot, kRot).norm()), 0.0);
}

TEST(ExtrinsicDoubt, TurnsTheVelocityWithTheWay) {
  WorldEstimate estimate;
  estimate.T_world_imu = kNow;
  estimate.v_world_imu = kVelocity;
  AddExtrinsicDoubt({kStd.rotation_rad, Vector3::Zero()}, estimate);
  const Vector3 up_imu = kTilt.conjugate() * Vector3::UnitZ();
  const double yaw_std = up_imu.cwiseProduct(kStd.rotation_rad).norm();
  const Vector3 aside = Vector3::UnitZ().cross(kVelocity);
  const Matrix3 expected = yaw_std * yaw_std * aside * aside.transpose();
  EXPECT_LT((estimate.cov.block<3, 3>(kVel, kVel) - expected).norm(), 1e-12);
}

TEST(ExtrinsicDoubt, InMapItIsTheSameInTheAxesOfTheBody) {
  WorldEstimate estimate;
  estimate.T_world_imu = kNow;
  AddExtrinsicDoubt(kStd, estimate);
  const Matrix3 R = kNow.rotation.toRotationMatrix();
  const Matrix6 in_map = ExtrinsicDoubtInMap(kStd, kNow);
  const Matrix3 back = R * in_map.topLeftCorner<3, 3>() * R.transpose();
  EXPECT_LT((back - estimate.cov.block<3, 3>(kPos, kPos)).norm(), 1e-12);
}

}  // namespace
}  // namespace lio
