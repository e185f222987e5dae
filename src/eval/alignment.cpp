// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/alignment.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

namespace lio {
namespace {

constexpr double kMinSpread_m =
    0.05;  // RMS spread across the path; a smaller one is noise, not shape

struct Centred {
  Vector3 truth_mean = Vector3::Zero();
  Vector3 estimate_mean = Vector3::Zero();
  Matrix3 covariance = Matrix3::Zero();  // covariance of truth (rows) with estimate (columns), m^2
};

Centred Centre(const PosePairs& pairs) {
  Centred result;
  const auto count = static_cast<double>(pairs.size());
  for (const PosePair& pair : pairs) {
    result.truth_mean += pair.truth.translation / count;
    result.estimate_mean += pair.estimate.translation / count;
  }
  for (const PosePair& pair : pairs) {
    result.covariance += (pair.truth.translation - result.truth_mean) *
                         (pair.estimate.translation - result.estimate_mean).transpose() / count;
  }
  return result;
}

// Returns the rotation R with the largest trace(R' m).
Matrix3 BestRotation(const Matrix3& m) {
  const Eigen::JacobiSVD<Matrix3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

// Returns the mean of R_truth R_estimate', which is the alignment's rotation as the attitudes
// measure it.
Matrix3 AttitudeCovariance(const PosePairs& pairs) {
  Matrix3 sum = Matrix3::Zero();
  for (const PosePair& pair : pairs) {
    sum += (pair.truth.rotation * pair.estimate.rotation.conjugate()).toRotationMatrix();
  }
  return sum / static_cast<double>(pairs.size());
}

struct RotationFit {
  Matrix3 rotation;
  bool used_attitude = false;
  double spread_m = 0;  // RMS spread that determines the weakest fitted angle
};

RotationFit Se3Rotation(const PosePairs& pairs, const Matrix3& covariance) {
  const Eigen::JacobiSVD<Matrix3> svd(covariance);
  const double spread_m = std::sqrt(svd.singularValues()(1));
  if (spread_m >= kMinSpread_m) return {BestRotation(covariance), false, spread_m};
  // The attitudes get as little weight as the smallest accepted spread, so that the path dominates
  // along the directions it determines.
  const double weight = kMinSpread_m * kMinSpread_m;
  return {BestRotation(covariance + weight * AttitudeCovariance(pairs)), true, spread_m};
}

RotationFit YawRotation(const PosePairs& pairs, const Matrix3& covariance) {
  const auto yaw = [](const Matrix3& m) {
    return std::atan2(m(1, 0) - m(0, 1), m(0, 0) + m(1, 1));
  };
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(covariance.topLeftCorner<2, 2>());
  const double spread_m = std::sqrt(svd.singularValues()(0));
  const bool used_attitude = spread_m < kMinSpread_m;
  const double angle = yaw(used_attitude ? AttitudeCovariance(pairs) : covariance);
  return {Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix(), used_attitude, spread_m};
}

double ResidualRms(const PosePairs& pairs, const Pose& T_truth_estimate) {
  double sum_sq = 0;
  for (const PosePair& pair : pairs) {
    const Vector3 moved = T_truth_estimate * pair.estimate.translation;
    sum_sq += (moved - pair.truth.translation).squaredNorm();
  }
  return std::sqrt(sum_sq / static_cast<double>(pairs.size()));
}

}  // namespace

PathAlignment Align(const PosePairs& pairs, AlignMode mode) {
  PathAlignment result;
  result.mode = mode;
  if (mode == AlignMode::kNone) return result;
  const Centred centred = Centre(pairs);
  const RotationFit fit = mode == AlignMode::kYaw ? YawRotation(pairs, centred.covariance)
                                                  : Se3Rotation(pairs, centred.covariance);
  result.T_truth_estimate = {Quaternion(fit.rotation).normalized(),
                             centred.truth_mean - fit.rotation * centred.estimate_mean};
  result.used_attitude = fit.used_attitude;
  if (!fit.used_attitude) {
    const double residual_m = ResidualRms(pairs, result.T_truth_estimate);
    result.rotation_uncertainty_deg =
        std::atan2(residual_m, fit.spread_m) * 180.0 / std::numbers::pi;
  }
  return result;
}

Quaternion MeanRotation(const std::vector<Quaternion>& rotations) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Quaternion& rotation : rotations) {
    sum += rotation.coeffs() * rotation.coeffs().transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  return Quaternion(Eigen::Vector4d(solver.eigenvectors().col(3))).normalized();
}

}  // namespace lio
