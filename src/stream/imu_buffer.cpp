// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/imu_buffer.hpp"

#include <algorithm>

#include "lio/filter/sample_lookup.hpp"
#include "lio/imu/imu_noise_estimator.hpp"
#include "lio/sensor/gap.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {

std::optional<Timestamp> ImuBuffer::newest() const {
  if (sent_.empty()) return std::nullopt;
  return sent_.back().stamp;
}

std::vector<ImuSample> ImuBuffer::Between(Timestamp from, Timestamp to) const {
  std::vector<ImuSample> between;
  for (auto at = FirstNotBefore(samples_, from); at != samples_.end() && at->stamp <= to; ++at) {
    between.push_back(*at);
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
// taken for a turn and a push.
void ImuBuffer::BridgeTo(Timestamp stamp, std::vector<ImuReady>& ready) {
  if (!sent_.empty() && stamp - sent_.back().stamp >= kImuGap.bridged) {
    const Timestamp first = sent_.back().stamp + kStream.gap_edge;
    const Timestamp last = stamp - kStream.gap_edge;
    Keep(Bridge().BeginLine(first, last), true, ready);
    AddMadeUp(last, ready);
  }
  bridge_.reset();
}

const GapBridge& ImuBuffer::Bridge() {
  if (!bridge_) bridge_.emplace(sent_, convention_);
  return *bridge_;
}

void ImuBuffer::AddMadeUp(Timestamp stamp, std::vector<ImuReady>& ready) {
  Keep(Bridge().At(stamp), true, ready);
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
  bridge_.reset();
  frozen_until_.reset();
}

}  // namespace lio
