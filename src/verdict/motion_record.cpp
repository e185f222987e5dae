// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/motion_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/filter/preintegration.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

// The mean of the samples about `stamp`; of all when none is near.
ImuSample MeanAbout(std::span<const ImuSample> samples, Timestamp stamp, double half_s) {
  ImuSample mean;
  double num = 0.0;
  for (const ImuSample& sample : samples) {
    if (std::abs(SecondsBetween(sample.stamp, stamp)) > half_s) continue;
    mean.w_imu_radps += sample.w_imu_radps;
    mean.f_imu_mps2 += sample.f_imu_mps2;
    num += 1.0;
  }
  if (num == 0.0) return samples.back();
  mean.w_imu_radps /= num;
  mean.f_imu_mps2 /= num;
  return mean;
}

// They are too far apart to follow the motion between them.
bool AreSparse(std::span<const ImuSample> samples) {
  const auto is_gap = [](const ImuSample& a, const ImuSample& b) {
    return b.stamp - a.stamp > kImuGap.sparse;
  };
  return std::ranges::adjacent_find(samples, is_gap) != samples.end();
}

// Samples about both ends tell how rate and force change with the offset between the clocks.
void AddGains(Timestamp from, Timestamp to, std::span<const ImuSample> samples,
              const Preintegration& motion, MotionStep& step) {
  const ImuSample at_from = MeanAbout(samples, from, kMotionRecord.instant_s);
  const ImuSample at_to = MeanAbout(samples, to, kMotionRecord.instant_s);
  step.rate_gain_radps = at_to.w_imu_radps - motion.rotation.conjugate() * at_from.w_imu_radps;
  step.jerk_mps3 = (at_to.f_imu_mps2 - at_from.f_imu_mps2) / motion.span_s();
}

}  // namespace

std::optional<Timestamp> MotionRecord::last_stamp() const {
  return last_ ? std::optional(last_->stamp) : std::nullopt;
}

void MotionRecord::BeginMap() {
  ++map_;
  Interrupt();
}

void MotionRecord::Clear() {
  steps_.clear();
  BeginMap();
}

void MotionRecord::SetImu(const Pose& T_old_new) {
  for (MotionStep& step : steps_) {
    step.from.pose = step.from.pose * T_old_new;
    step.to.pose = step.to.pose * T_old_new;
  }
  if (last_) last_->pose = last_->pose * T_old_new;
}

void MotionRecord::Add(const StampedPose& T_map_imu, Duration clock_correction,
                       std::span<const ImuSample> samples) {
  const Duration change = clock_correction - std::exchange(clock_correction_, clock_correction);
  if (std::abs(change.Seconds()) > kMotionRecord.max_correction_change_s) ++track_;
  std::optional<StampedPose> last = std::exchange(last_, T_map_imu);
  if (last) last->stamp = last->stamp + change;
  const bool is_step = last && samples.size() >= 3 && T_map_imu.stamp > last->stamp &&
                       SecondsBetween(last->stamp, T_map_imu.stamp) <= kMotionRecord.max_step_s &&
                       AreMeasured(samples);
  if (!is_step) {
    ++track_;
    return;
  }
  MotionStep step;
  step.map = map_;
  step.track = track_;
  step.from = *last;
  step.to = T_map_imu;
  const Preintegration motion =
      Preintegrate(samples, last->stamp, T_map_imu.stamp, Biases{}, ProcessNoise{});
  step.turn_rad = LogSo3(motion.rotation);
  const Quaternion half_turn_back = ExpSo3(-0.5 * step.turn_rad);
  step.velocity_mps = half_turn_back * motion.velocity;
  step.position_m = half_turn_back * motion.position;
  // Sparse samples tell nothing of the clock offset (sensor/gap.hpp).
  step.rate_gain_radps.setZero();
  step.jerk_mps3.setZero();
  if (!AreSparse(samples)) AddGains(last->stamp, T_map_imu.stamp, samples, motion, step);
  step.clock_correction_s = clock_correction.Seconds();
  if (steps_.size() >= kMotionRecord.max_steps) steps_.pop_front();
  steps_.push_back(step);
}

}  // namespace lio
