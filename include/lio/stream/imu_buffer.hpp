// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps the inertial samples of the last seconds, by stamp: as they were sent, and as they are read
// under the IMU convention (units, axes) that is believed. Gaps in the stream are bridged here.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/imu_noise.hpp"
#include "lio/stream/gap_bridge.hpp"
#include "lio/stream/stream_event.hpp"

namespace lio {

class ImuBuffer {
 public:
  // Counts into `counters`, which outlives this.
  ImuBuffer(const ImuConvention& convention, Counters& counters)
      : convention_(convention), counters_(&counters) {}

  // Has a sweep used the samples up to this stamp? Then none may be added there.
  [[nodiscard]] bool IsFrozen(Timestamp stamp) const {
    return frozen_until_ && stamp <= *frozen_until_;
  }
  // Appends to `ready` what the sample adds: samples that bridge a gap before it, and itself,
  // unless no gyro can turn as fast as it reads under the convention. Returns false when a sample
  // of that stamp is there already.
  [[nodiscard]] bool Add(const ImuSample& sent, std::vector<ImuReady>& ready);
  // From here on nothing up to `stamp` may change; where the stream has not reached it, a made-up
  // sample is added there.
  void FreezeUpTo(Timestamp stamp, std::vector<ImuReady>& ready);
  // Reads all samples under another convention, those in the buffer included.
  void SetConvention(const ImuConvention& convention);
  void Clear();

  const ImuConvention& convention() const { return convention_; }
  const std::deque<ImuSample>& sent() const { return sent_; }
  // They are in SI units and the imu's axes, without those that no gyro can have read.
  const std::deque<ImuSample>& samples() const { return samples_; }
  // Returns the samples() from the one stamp to the other, both included.
  [[nodiscard]] std::vector<ImuSample> Between(Timestamp from, Timestamp to) const;
  [[nodiscard]] std::optional<Timestamp> newest() const;
  // Returns the noise that the samples of the second before `stamp` show; zero where they are too
  // few. Up to a frozen stamp neither late samples nor the order of arrival change it.
  [[nodiscard]] ImuNoise NoiseAt(Timestamp stamp) const;

 private:
  bool Keep(const ImuSample& sent, bool is_made_up, std::vector<ImuReady>& ready);
  std::optional<ImuSample> Read(const ImuSample& sent);
  void BridgeTo(Timestamp stamp, std::vector<ImuReady>& ready);
  // The bridge across the present gap. It begins after the newest sample if there was none yet.
  const GapBridge& Bridge();
  void AddMadeUp(Timestamp stamp, std::vector<ImuReady>& ready);

  ImuConvention convention_;
  Counters* counters_;
  std::deque<ImuSample> sent_;
  std::deque<ImuSample> samples_;
  std::optional<GapBridge> bridge_;  // while the stream has a gap
  std::optional<Timestamp> frozen_until_;
};

}  // namespace lio
