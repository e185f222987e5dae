// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/imu_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "lio/filter/sample_lookup.hpp"
#include "lio/imu/imu_noise_estimator.hpp"
#include "lio/imu/rest.hpp"
#include "lio/sensor/gap.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {

std::optional<Timestamp> ImuBuffer::newest() const {
  if (sent_.empty()) return std::nullopt;
  return sent_.back().stamp;
}

std::vector<ImuSample> ImuBuffer::Between(Timestamp from, Timestamp to) const {
  std::vector<ImuSample> between;
  for (const ImuSample& sample : samples_) {
    if (sample.stamp >= from && sample.stamp <= to) between.push_back(sample);
  }
  return between;
}

bool ImuBuffer::Add(const ImuSample& sent, std::vector<ImuReady>& ready) {
  if (sent_.empty() || sent.stamp > sent_.back().stamp) BridgeTo(sent.stamp, ready);
  return Keep(sent, false, ready);
}

bool ImuBuffer::Keep(const ImuSample& sent, bool is_made_up, std::vector<ImuReady>& ready) {
  if (!InsertByStamp(sent_, sent)) return false;
  const Timestamp oldest = sent_.back().stamp - Duration::FromSeconds(kStream.imu_buffer_s);
  while (sent_.front().stamp < oldest || sent_.size() > kStream.max_imu_samples) sent_.pop_front();
  const Timestamp first = sent_.front().stamp;
  while (!samples_.empty() && samples_.front().stamp < first) samples_.pop_front();
  const std::optional<ImuSample> sample = Read(sent);
  if (!sample) return true;
  InsertByStamp(samples_, *sample);
  ready.push_back({*sample, is_made_up});
  return true;
}

std::optional<ImuSample> ImuBuffer::Read(const ImuSample& sent) {
  const ImuSample sample = ToSi(convention_, sent);
  if (sample.w_imu_radps.norm() <= kMaxGyroRate_radps) return sample;
  ++counters_->num_imu_out_of_range;
  if (!sent.is_made_up()) {
    counters_->ledgers.samples.Move(SampleFate::kUsed, SampleFate::kOutOfRange);
  }
  return std::nullopt;
}

// Across a gap neither the last sample holds nor a line to the next one: a walker's steps would be
// taken for a turn and a push. The mean of the time before holds.
void ImuBuffer::BridgeTo(Timestamp stamp, std::vector<ImuReady>& ready) {
  if (!sent_.empty() && stamp - sent_.back().stamp >= kImuGap.bridged) {
    for (const Timestamp at : {sent_.back().stamp + kStream.gap_edge, stamp - kStream.gap_edge}) {
      AddMadeUp(at, ready);
    }
  }
  mean_before_gap_.reset();
}

// The motion in a gap is as far from the one before as that of the last seconds was, per axis.
// Never zero, so that a made-up sample is told from a measured one.
float ImuBuffer::StdAround(const Vector3& mean, Vector3 ImuSample::*value) const {
  double sum_sq = kStream.min_made_up_std * kStream.min_made_up_std;
  int num_samples = 1;
  for (const ImuSample& sample : sent_) {
    const bool is_readable = ToSi(convention_, sample).w_imu_radps.norm() <= kMaxGyroRate_radps;
    if (sample.is_made_up() || !is_readable) continue;
    sum_sq += (sample.*value - mean).squaredNorm();
    ++num_samples;
  }
  return static_cast<float>(std::sqrt(sum_sq / (3.0 * num_samples)));
}

void ImuBuffer::AddMadeUp(Timestamp stamp, std::vector<ImuReady>& ready) {
  if (!mean_before_gap_) {
    const Timestamp from = sent_.back().stamp - Duration::FromSeconds(kStream.mean_before_gap_s);
    const ImuStatistics before =
        Summarise(std::vector<ImuSample>(FirstNotBefore(sent_, from), sent_.cend()));
    mean_before_gap_ = sent_.back();
    mean_before_gap_->w_imu_radps = before.mean_w_radps;
    mean_before_gap_->f_imu_mps2 = before.mean_f_mps2;
    const ImuSample& mean = *mean_before_gap_;
    mean_before_gap_->made_up_w_std_radps = StdAround(mean.w_imu_radps, &ImuSample::w_imu_radps);
    mean_before_gap_->made_up_f_std_mps2 = StdAround(mean.f_imu_mps2, &ImuSample::f_imu_mps2);
  }
  mean_before_gap_->stamp = stamp;
  Keep(*mean_before_gap_, true, ready);
}

void ImuBuffer::FreezeUpTo(Timestamp stamp, std::vector<ImuReady>& ready) {
  const auto bracket = FirstNotBefore(sent_, stamp);
  if (bracket == sent_.end()) {
    AddMadeUp(stamp, ready);
    frozen_until_ = stamp;
  } else {
    frozen_until_ = bracket->stamp;
  }
}

ImuNoise ImuBuffer::NoiseAt(Timestamp stamp) const {
  return EstimateNoise(Between(stamp - Duration::FromSeconds(kImuNoise.window_s), stamp));
}

void ImuBuffer::SetConvention(const ImuConvention& convention) {
  counters_->num_imu_out_of_range -= std::ssize(sent_) - std::ssize(samples_);
  const auto num_measured = [](const std::deque<ImuSample>& samples) {
    return std::count_if(samples.begin(), samples.end(),
                         [](const ImuSample& sample) { return !sample.is_made_up(); });
  };
  counters_->ledgers.samples.Move(SampleFate::kOutOfRange, SampleFate::kUsed,
                                  num_measured(sent_) - num_measured(samples_));
  samples_.clear();
  convention_ = convention;
  for (const ImuSample& sent : sent_) {
    if (const std::optional<ImuSample> sample = Read(sent)) samples_.push_back(*sample);
  }
}

void ImuBuffer::Clear() {
  sent_.clear();
  samples_.clear();
  mean_before_gap_.reset();
  frozen_until_.reset();
}

}  // namespace lio
