// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_offset.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lio/base/chi_square.hpp"
#include "lio/filter/preintegration.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr ClockOffsetParameters kClockOffset = kFilterParameters.clock_offset;

Preintegration Gyro(std::span<const ImuSample> samples, Timestamp from, Timestamp to,
                    const Vector3& bias, double density) {
  ProcessNoise noise;
  noise.gyro_density = density;
  return Preintegrate(samples, from, to, {bias, Vector3::Zero()}, noise);
}

// Samples are missing, or were made up in their place (stream/imu_buffer.hpp): the line between the
// others does not follow the motion.
bool AreSparse(std::span<const ImuSample> samples) {
  return std::ranges::adjacent_find(samples, [](const ImuSample& a, const ImuSample& b) {
           return b.stamp - a.stamp > kImuGap.sparse;
         }) != samples.end();
}

// Returns the mean over the time by which the stamp may be wrong: noise and vibration average out.
Vector3 MeanRate(std::span<const ImuSample> samples, Timestamp stamp, const Vector3& bias) {
  const Duration half = Duration::FromSeconds(0.5 * kClockOffset.rate_span_s);
  const Quaternion turn = Gyro(samples, stamp - half, stamp + half, bias, 0.0).rotation;
  return LogSo3(turn) / kClockOffset.rate_span_s;
}

}  // namespace

ClockOffset::ClockOffset(const ClockBelief& belief) : belief_(belief) {}

double ClockOffset::std_s() const {
  return std::sqrt(belief_.cov(kOffset, kOffset));
}

double ClockOffset::rate_std() const {
  return std::sqrt(belief_.cov(kRate, kRate));
}

void ClockOffset::Interrupt() {
  last_.reset();
  samples_.clear();
}

void ClockOffset::Add(const Scan& scan, std::span<const ImuSample> samples) {
  for (const ImuSample& sample : samples) {
    if (samples_.empty() || sample.stamp > samples_.back().stamp) samples_.push_back(sample);
  }
  Predict(scan.stamp);
  if (last_ && scan.stamp > last_->stamp) Update(scan);
  Follow();
  last_ = scan;
  const Timestamp begin = scan.stamp - kScanGap.unrelated;
  while (!samples_.empty() && samples_.front().stamp < begin) samples_.pop_front();
}

void ClockOffset::Predict(Timestamp now) {
  const Timestamp before = std::exchange(as_of_, now).value_or(now);
  age_s_ += PassedTime_s(before, now);
  const ClockEstimate predicted = Predicted({belief_.mean, belief_.cov, before}, now);
  belief_ = {predicted.mean, predicted.cov};
  belief_.mean(kOffset) = std::clamp(offset_s(), -kMax_s, kMax_s);
  const double excess = std_s() / kClockOffset.max_std_s;
  if (excess <= 1.0) return;
  belief_.cov.row(kOffset) /= excess;
  belief_.cov.col(kOffset) /= excess;
}

void ClockOffset::Update(const Scan& scan) {
  const double span_s = SecondsBetween(last_->stamp, scan.stamp);
  if (scan.stamp - last_->stamp > kScanGap.unrelated || samples_.size() < 3) return;
  const std::vector<ImuSample> samples(samples_.begin(), samples_.end());
  if (AreSparse(samples)) return;
  const Preintegration gyro =
      Gyro(samples, last_->stamp, scan.stamp, scan.gyro_bias, scan.gyro_density);
  const Quaternion matched = last_->R_map_imu.conjugate() * scan.R_map_imu;
  const Vector3 residual = LogSo3(gyro.rotation.conjugate() * matched);
  const Vector3 w = MeanRate(samples, scan.stamp, scan.gyro_bias);
  const Vector3 w_last =
      gyro.rotation.conjugate() * MeanRate(samples, last_->stamp, scan.gyro_bias);
  Turn turn;
  turn.rate_change_radps = w - w_last;
  turn.rate_change_std_radps = std::sqrt(2.0 / kClockOffset.rate_span_s) * scan.gyro_density;
  turn.innovation_rad = residual + w * scan.moved_by_s - w_last * last_->moved_by_s -
                        turn.rate_change_radps * offset_s();
  turn.claimed_var =
      scan.rotation_var + last_->rotation_var + scan.gyro_density * scan.gyro_density * span_s;
  Fuse(turn);
}

void ClockOffset::Fuse(const Turn& turn) {
  const Vector3& h = turn.rate_change_radps;
  const double turn_var = turn.claimed_var + unclaimed_var_;
  const double offset_var = belief_.cov(kOffset, kOffset);
  const Matrix3 S = offset_var * h * h.transpose() + turn_var * Matrix3::Identity();
  LearnUnclaimed(turn);
  if (turn.innovation_rad.dot(S.inverse() * turn.innovation_rad) > kChiSquare3At999) return;
  if (h.norm() < std::max(kClockOffset.min_rate_change_radps,
                          kClockOffset.min_rate_change_sigmas * turn.rate_change_std_radps)) {
    return;
  }
  // h' S^-1 = h' / innovation_var, since S is the identity but for its part along h.
  const double innovation_var = turn_var + offset_var * h.squaredNorm();
  const Eigen::Vector2d gain = belief_.cov.col(kOffset) / innovation_var;
  belief_.mean += gain * h.dot(turn.innovation_rad);
  belief_.mean(kOffset) = std::clamp(offset_s(), -kMax_s, kMax_s);
  belief_.cov -= h.squaredNorm() * gain * belief_.cov.row(kOffset).eval();
  ++num_turns_;
}

// Across the change of rate an offset shows nothing, so that the scatter there is that of the turns
// alone.
void ClockOffset::LearnUnclaimed(const Turn& turn) {
  const Vector3 along = turn.rate_change_radps.stableNormalized();
  const Vector3 across = turn.innovation_rad - along * along.dot(turn.innovation_rad);
  const double var = 0.5 * across.squaredNorm();
  const double limit = kClockOffset.max_scatter_ratio * (turn.claimed_var + unclaimed_var_);
  unclaimed_var_ += (std::min(var, limit) - turn.claimed_var - unclaimed_var_) /
                    kClockOffset.num_turns_remembered;
  unclaimed_var_ = std::max(unclaimed_var_, 0.0);
}

bool ClockOffset::IsSure(double offset_s, double std_s, double beyond_s) {
  return std_s <= kClockOffset.known_std_s ||
         std::abs(offset_s - beyond_s) > kClockOffset.sure_sigmas * std_s;
}

// The rate is constant, and the offset has walked since.
ClockBelief ClockOffset::AtFirstScan() const {
  const Eigen::Matrix2d back = ClockTransition(-age_s_);
  ClockBelief belief{back * belief_.mean, back * belief_.cov * back.transpose()};
  double& var = belief.cov(kOffset, kOffset);
  var += kClockOffset.walk_s_per_sqrt_s * kClockOffset.walk_s_per_sqrt_s * age_s_;
  const double offset_s = belief.mean[kOffset];
  const bool is_possible = std::abs(offset_s) <= kMax_s && std::sqrt(var) <= kClockOffset.max_std_s;
  const bool is_known = is_found_ && is_possible && IsSure(offset_s, std::sqrt(var), 0.0);
  return is_known ? belief : ClockBelief{};
}

std::optional<ClockEstimate> ClockOffset::Found() const {
  if (!is_found_ || !as_of_) return std::nullopt;
  return ClockEstimate{belief_.mean, belief_.cov, *as_of_};
}

void ClockOffset::Follow() {
  is_found_ |= num_turns_ >= kClockOffset.min_turns && IsSure(offset_s(), std_s(), move_by_s_);
  if (!is_found_) return;
  move_by_s_ +=
      std::clamp(offset_s() - move_by_s_, -kClockOffset.max_step_s, kClockOffset.max_step_s);
}

}  // namespace lio
