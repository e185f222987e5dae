// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/pose_update.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "lio/filter/map_bend.hpp"

namespace lio {
namespace {

// P <- (I - K H) P (I - K H)^T + K R K^T, then K r is injected and P <- G P G^T.
template <int kRows>
void Apply(Estimate& estimate, const Eigen::Matrix<double, kRows, kStateDim>& H,
           const Eigen::Matrix<double, kStateDim, kRows>& K,
           const Eigen::Matrix<double, kRows, 1>& residual,
           const Eigen::Matrix<double, kRows, kRows>& R) {
  const ErrorMatrix remain = ErrorMatrix::Identity() - K * H;
  const ErrorMatrix joseph = remain * estimate.cov * remain.transpose() + K * R * K.transpose();
  const ErrorVector error = K * residual;
  // Errors are now relative to the new nominal poses.
  const ErrorMatrix reset = InjectJacobian(estimate.state, error);
  estimate.state = Inject(estimate.state, error);
  const ErrorMatrix cov = reset * joseph * reset.transpose();
  estimate.cov = 0.5 * (cov + cov.transpose());
}

}  // namespace

UpdateResult FusePose(Estimate& estimate, const PoseMeasurement& measurement, double nis_limit) {
  const Vector6 residual = LogSe3(estimate.state.T_map_imu.Inverse() * measurement.T_map_imu);
  Eigen::Matrix<double, 6, kStateDim> H = Eigen::Matrix<double, 6, kStateDim>::Zero();
  H.middleCols<6>(kMapPose) = LeftJacobianInverseSe3(residual);
  const Matrix6 noise_jacobian = RightJacobianInverseSe3(residual);
  const Matrix6 R = noise_jacobian * measurement.cov * noise_jacobian.transpose();

  const Eigen::Matrix<double, kStateDim, 6> PHt = estimate.cov * H.transpose();
  const Matrix6 S = H * PHt + R;
  const Eigen::LDLT<Matrix6> factor(S);
  UpdateResult result;
  result.nis = residual.dot(factor.solve(residual));
  const auto nis_of = [&](int at) {
    const Vector3 part = residual.segment<3>(at);
    return part.dot(S.block<3, 3>(at, at).ldlt().solve(part));
  };
  result.nis_translation = nis_of(0);
  result.nis_rotation = nis_of(3);
  if (!(result.nis <= nis_limit)) return result;
  const Eigen::Matrix<double, kStateDim, 6> K = factor.solve(PHt.transpose()).transpose();
  Apply<6>(estimate, H, K, residual, R);
  result.fused = true;
  return result;
}

UpdateResult FuseZeroVelocity(Estimate& estimate, double variance, double nis_limit) {
  Eigen::Matrix<double, 3, kStateDim> H = Eigen::Matrix<double, 3, kStateDim>::Zero();
  H.middleCols<3>(kVel).setIdentity();
  const Matrix3 R = variance * Matrix3::Identity();
  const Vector3 residual = -estimate.state.v_world_imu;
  const Eigen::LDLT<Matrix3> factor(estimate.cov.block<3, 3>(kVel, kVel) + R);
  UpdateResult result;
  result.nis = residual.dot(factor.solve(residual));
  if (!(result.nis <= nis_limit)) return result;
  const Eigen::Matrix<double, kStateDim, 3> K =
      factor.solve(estimate.cov.middleRows<3>(kVel)).transpose();
  Apply<3>(estimate, H, K, residual, R);
  result.fused = true;
  return result;
}

void BlendMapPose(Estimate& estimate, const PoseMeasurement& measurement) {
  ErrorMatrix& P = estimate.cov;
  Matrix6 keep = (1.0 - measurement.new_content_share) * Matrix6::Identity();
  if (measurement.knows_directions) keep = Matrix6::Identity() - measurement.share_by_direction;
  P.middleRows<6>(kMapPose) = (keep * P.middleRows<6>(kMapPose)).eval();
  P.middleCols<6>(kMapPose) = (P.middleCols<6>(kMapPose) * keep.transpose()).eval();
  P.block<6, 6>(kMapPose, kMapPose) += measurement.new_content_share * measurement.blend_cov;
  if (measurement.is_level) {
    estimate.state.T_map_imu = LevelMapPose(estimate.state, measurement.new_content_share);
  }
}

// cov (I - Phi)^-1 = cov + odds cov with odds = (I - Phi)^-1 Phi, whose symmetric part may be
// negative along a direction, since the two do not commute: that part adds nothing.
Matrix6 CovWithoutLastScan(const Matrix6& cov, const Matrix6& share_of_last_scan) {
  const Matrix6 odds =
      (Matrix6::Identity() - share_of_last_scan).partialPivLu().solve(share_of_last_scan);
  const Matrix6 added = odds * cov;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(0.5 * (added + added.transpose()));
  const Matrix6& axes = eigen.eigenvectors();
  return cov + axes * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * axes.transpose();
}

void FuseLinear(Estimate& estimate, const Eigen::MatrixXd& H, const Eigen::VectorXd& residual,
                const Eigen::MatrixXd& R) {
  const Eigen::MatrixXd PHt = estimate.cov * H.transpose();
  const Eigen::MatrixXd S = H * PHt + R;
  const Eigen::MatrixXd K = S.ldlt().solve(PHt.transpose()).transpose();
  Apply<Eigen::Dynamic>(estimate, H, K, residual, R);
}

}  // namespace lio
