// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/zero_velocity_detector.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "lio/base/chi_square.hpp"
#include "lio/imu/rest.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr RestOnTheWay kLimits = kRest.on_the_way;

bool IsPlausible(const Vector3& residual, const Matrix3& cov) {
  return residual.dot(cov.ldlt().solve(residual)) < kChiSquare3At999;
}

double MeanVariance(double density, double other_std, double span_s) {
  return density * density / span_s + other_std * other_std;
}

// The body neither turns nor speeds up, as far as the filter can tell.
bool IsUnmoved(const ImuStatistics& seen, const ImuRig& imu, const Estimate& estimate,
               const Vector3& g_world) {
  const NavState& state = estimate.state;
  const Matrix3 rate_cov =
      estimate.cov.block<3, 3>(kGyroBias, kGyroBias) +
      MeanVariance(imu.gyro_noise_density, kLimits.mean_rate_std_radps, seen.span_s) *
          Matrix3::Identity();
  if (!IsPlausible(seen.mean_w_radps - state.gyro_bias, rate_cov)) return false;
  // f = -R^T g + accel bias
  const Vector3 at_rest = -(state.T_world_imu.rotation.conjugate() * g_world);
  Eigen::Matrix<double, 3, kStateDim> H = Eigen::Matrix<double, 3, kStateDim>::Zero();
  H.middleCols<3>(kRot) = Hat(at_rest);
  H.middleCols<3>(kAccelBias) = Matrix3::Identity();
  const Matrix3 force_cov =
      H * estimate.cov * H.transpose() +
      MeanVariance(imu.accel_noise_density, kLimits.mean_force_std_mps2, seen.span_s) *
          Matrix3::Identity();
  return IsPlausible(seen.mean_f_mps2 - at_rest - state.accel_bias, force_cov);
}

struct Line {
  Timestamp stamp;
  Vector3 place_m = Vector3::Zero();  // at `stamp`
  Vector3 speed_mps = Vector3::Zero();

  Vector3 At(Timestamp when) const { return place_m + SecondsBetween(stamp, when) * speed_mps; }
};

// Fits a line through the places of the matched scans by least squares.
Line FitLine(const std::deque<ZeroVelocityScan>& scans) {
  const auto num = static_cast<double>(scans.size());
  double time_s = 0.0;
  Vector3 place_m = Vector3::Zero();
  for (const ZeroVelocityScan& scan : scans) {
    time_s += SecondsBetween(scans.front().stamp, scan.stamp) / num;
    place_m += scan.position_map_m / num;
  }
  Line line{scans.front().stamp + Duration::FromSeconds(time_s), place_m};
  double squares_s2 = 0.0;
  Vector3 products_ms = Vector3::Zero();
  for (const ZeroVelocityScan& scan : scans) {
    const double dt_s = SecondsBetween(line.stamp, scan.stamp);
    squares_s2 += dt_s * dt_s;
    products_ms += dt_s * (scan.position_map_m - place_m);
  }
  if (squares_s2 > 0.0) line.speed_mps = products_ms / squares_s2;
  return line;
}

}  // namespace

void ZeroVelocityDetector::Add(ZeroVelocityScan scan) {
  if (!scans_.empty() && scan.stamp - scans_.back().stamp > kScanGap.unrelated) Forget();
  const Timestamp begin = scan.stamp - Duration::FromSeconds(kLimits.window_s);
  scans_.push_back(std::move(scan));
  while (scans_.size() > 1 && scans_[1].stamp <= begin) scans_.pop_front();
}

void ZeroVelocityDetector::Forget() {
  scans_.clear();
  stands_ = false;
}

void ZeroVelocityDetector::BeginAtRest() {
  Forget();
  stands_ = true;
}

double ZeroVelocityDetector::Span_s() const {
  return SecondsBetween(scans_.front().stamp, scans_.back().stamp);
}

// Single matches of few points scatter by centimetres; a line through many does not.
bool ZeroVelocityDetector::IsInPlace() const {
  const Line line = FitLine(scans_);
  const double max_m = Span_s() < kLimits.window_s ? kLimits.max_scatter_m : kLimits.max_shift_m;
  return line.speed_mps.norm() * Span_s() < max_m &&
         std::all_of(scans_.begin(), scans_.end(), [&](const ZeroVelocityScan& scan) {
           return (scan.position_map_m - line.At(scan.stamp)).norm() < kLimits.max_scatter_m;
         });
}

bool ZeroVelocityDetector::IsStillToImu(const Estimate& estimate, const Vector3& g_world) const {
  std::vector<ImuSample> samples;
  for (const ZeroVelocityScan& scan : scans_) {
    samples.insert(samples.end(), scan.samples.begin(), scan.samples.end());
  }
  if (samples.size() < 2) return false;
  const ImuStatistics seen = Summarise(samples);
  return seen.span_s >= Span_s() && IsCalm(seen, imu_, kLimits.idle) &&
         IsUnmoved(seen, imu_, estimate, g_world);
}

bool ZeroVelocityDetector::Judge(const Estimate& estimate, const Vector3& g_world) {
  if (scans_.empty()) return false;
  stands_ =
      (stands_ || Span_s() >= kLimits.window_s) && IsInPlace() && IsStillToImu(estimate, g_world);
  return stands_;
}

}  // namespace lio
