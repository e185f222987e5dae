// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "calib/rate_search.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "calib/calibration_parameters.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr double kGridStep_s = kCalibrationParameters.search.grid_step_s;
constexpr double kFineStep_s = kCalibrationParameters.search.fine_step_s;
constexpr int kMinTurns = kCalibrationParameters.search.min_turns;

}  // namespace

RateSearch::RateSearch(std::span<const ImuSample> samples, std::span<const LidarTurn> turns)
    : turns_(turns) {
  if (samples.empty()) return;
  begin_ = samples.front().stamp;
  Sum sum{Vector3::Zero(), 0};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t_s = SecondsBetween(begin_, samples[i].stamp);
    if (i > 0) {
      const double step_s = t_s - t_s_.back();
      sum.angle += 0.5 * step_s * (samples[i - 1].w_imu_radps + samples[i].w_imu_radps);
      if (samples[i].stamp - samples[i - 1].stamp > kImuGap.unmeasured) ++sum.num_gaps;
    }
    t_s_.push_back(t_s);
    sums_.push_back(sum);
  }
}

bool RateSearch::SumAt(double t_s, Sum& sum) const {
  const auto after = std::upper_bound(t_s_.begin(), t_s_.end(), t_s);
  if (after == t_s_.begin() || after == t_s_.end()) return false;
  const auto i = static_cast<std::size_t>(after - t_s_.begin());
  const double step_s = t_s_[i] - t_s_[i - 1];
  if (sums_[i].num_gaps != sums_[i - 1].num_gaps) return false;
  const double fraction = (t_s - t_s_[i - 1]) / step_s;
  sum.angle = sums_[i - 1].angle + fraction * (sums_[i].angle - sums_[i - 1].angle);
  sum.num_gaps = sums_[i].num_gaps;
  return true;
}

RateSearch::Rates RateSearch::RatesAt(double offset_s) const {
  Rates rates;
  for (const LidarTurn& turn : turns_) {
    const double from_s = SecondsBetween(begin_, turn.from) + offset_s;
    Sum from, to;
    if (!SumAt(from_s, from) || !SumAt(from_s + turn.span_s(), to)) continue;
    if (to.num_gaps != from.num_gaps) continue;
    rates.gyro.emplace_back((to.angle - from.angle) / turn.span_s());
    rates.lidar.emplace_back(turn.rotation_lidar / turn.span_s());
  }
  return rates;
}

RateMatch RateSearch::At(double offset_s) const {
  RateMatch match;
  match.offset_s = offset_s;
  const auto [gyro, lidar] = RatesAt(offset_s);
  match.num_turns = static_cast<int>(gyro.size());
  if (match.num_turns < kMinTurns) return match;
  Vector3 gyro_mean = Vector3::Zero();
  Vector3 lidar_mean = Vector3::Zero();
  for (std::size_t i = 0; i < gyro.size(); ++i) {
    gyro_mean += gyro[i];
    lidar_mean += lidar[i];
  }
  gyro_mean /= match.num_turns;
  lidar_mean /= match.num_turns;
  Matrix3 cross = Matrix3::Zero();
  double gyro_sq = 0.0;
  double lidar_sq = 0.0;
  for (std::size_t i = 0; i < gyro.size(); ++i) {
    const Vector3 g = gyro[i] - gyro_mean;
    const Vector3 l = lidar[i] - lidar_mean;
    cross += g * l.transpose();
    gyro_sq += g.squaredNorm();
    lidar_sq += l.squaredNorm();
  }
  const Eigen::JacobiSVD<Matrix3> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1.0 : 1.0;
  const Vector3 signs(1.0, 1.0, sign);
  match.R_imu_lidar = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  match.gyro_bias_radps = gyro_mean - match.R_imu_lidar * lidar_mean;
  match.gyro_rate_rms_radps = std::sqrt(gyro_sq / match.num_turns);
  const double size = std::sqrt(gyro_sq * lidar_sq);
  if (size > 0) match.correlation = svd.singularValues().dot(signs) / size;
  const Vector3& sizes = svd.singularValues();
  if (sizes.x() > 0) match.second_axis_ratio = sizes.y() / sizes.x();
  return match;
}

RateMatch RateSearch::Run(double max_offset_s) const {
  RateMatch best;
  const auto try_around = [&](double middle_s, double step_s, int num_steps) {
    for (int i = -num_steps; i <= num_steps; ++i) {
      const RateMatch match = At(middle_s + i * step_s);
      if (match.correlation > best.correlation) best = match;
    }
  };
  try_around(0.0, kGridStep_s, static_cast<int>(std::ceil(max_offset_s / kGridStep_s)));
  if (best.correlation <= 0.0) return best;
  try_around(best.offset_s, kFineStep_s, static_cast<int>(kGridStep_s / kFineStep_s));
  // The best offset is the vertex of the parabola through three points.
  const double before = At(best.offset_s - kFineStep_s).correlation;
  const double after = At(best.offset_s + kFineStep_s).correlation;
  const double bend = before - 2.0 * best.correlation + after;
  if (bend >= 0.0) return best;
  const double shift = std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
  return At(best.offset_s + shift * kFineStep_s);
}

}  // namespace lio
