// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/standstill.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/base/chi_square.hpp"
#include "lio/imu/start_state.hpp"

namespace lio {
namespace {

// What an idling engine adds to the sensors' noise.
constexpr Unrest kTremble{0.005, 0.08};
// What it, and errors of the sensors that the filter does not know, leave in means.
constexpr double kMeanRateStd_radps = 5e-4;
constexpr double kMeanForceStd_mps2 = 0.01;

bool IsPlausible(const Vector3& residual, const Matrix3& cov) {
  return residual.dot(cov.ldlt().solve(residual)) < kChiSquare3At999;
}

double MeanVariance(double density, double other_std, double span_s) {
  return density * density / span_s + other_std * other_std;
}

// Neither turning nor speeding up, as far as the filter can tell.
bool IsUnmoved(const ImuStatistics& seen, const ImuRig& imu, const Estimate& estimate,
               const Vector3& g_world) {
  const NavState& state = estimate.state;
  const Matrix3 rate_cov =
      estimate.cov.block<3, 3>(kGyroBias, kGyroBias) +
      MeanVariance(imu.gyro_noise_density, kMeanRateStd_radps, seen.span_s) * Matrix3::Identity();
  if (!IsPlausible(seen.mean_w_radps - state.gyro_bias, rate_cov)) return false;
  // f = -R^T g + accel bias
  const Vector3 at_rest = -(state.T_world_imu.rotation.conjugate() * g_world);
  Eigen::Matrix<double, 3, kStateDim> H = Eigen::Matrix<double, 3, kStateDim>::Zero();
  H.middleCols<3>(kRot) = Hat(at_rest);
  H.middleCols<3>(kAccelBias) = Matrix3::Identity();
  const Matrix3 force_cov =
      H * estimate.cov * H.transpose() +
      MeanVariance(imu.accel_noise_density, kMeanForceStd_mps2, seen.span_s) * Matrix3::Identity();
  return IsPlausible(seen.mean_f_mps2 - at_rest - state.accel_bias, force_cov);
}

}  // namespace

void Standstill::Add(StandstillScan scan) {
  const Timestamp begin = scan.stamp - Duration::FromSeconds(kWindow_s);
  scans_.push_back(std::move(scan));
  while (scans_.size() > 1 && scans_[1].stamp <= begin) scans_.pop_front();
}

bool Standstill::IsInPlace() const {
  return std::all_of(scans_.begin(), scans_.end(), [this](const StandstillScan& a) {
    return std::all_of(scans_.begin(), scans_.end(), [&a](const StandstillScan& b) {
      return (a.position_map_m - b.position_map_m).norm() < kMaxShift_m;
    });
  });
}

bool Standstill::Holds(const Estimate& estimate, const Vector3& g_world) const {
  if (scans_.empty()) return false;
  const double span_s = SecondsBetween(scans_.front().stamp, scans_.back().stamp);
  if (span_s < kWindow_s || !IsInPlace()) return false;
  std::vector<ImuSample> samples;
  for (const StandstillScan& scan : scans_) {
    samples.insert(samples.end(), scan.samples.begin(), scan.samples.end());
  }
  const ImuStatistics seen = Summarise(samples);
  return seen.span_s >= kWindow_s && IsCalm(seen, imu_, kTremble) &&
         IsUnmoved(seen, imu_, estimate, g_world);
}

}  // namespace lio
