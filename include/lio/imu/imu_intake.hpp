// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decides what to believe of the inertial stream before anything is integrated: drops what is not
// finite or out of range, and holds samples whose stamp jumps until the samples after them say
// whether one stamp was wrong, whether they are merely late, or whether the clock was set. Only
// stamps decide, never the wall clock.
//
// Late samples fill a hole in the stream; those of a clock that was set back by less than a second
// tell of a time that others have told of already. A step back of less than five samples is not
// seen: those samples are dropped as repeats or mixed in.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lio/imu/imu_reading.hpp"
#include "lio/pipeline/outputs.hpp"

namespace lio {

class ImuIntake {
 public:
  // Counts into `counters`, which outlives this. Rates beyond `max_rate`, in the samples' unit, are
  // no gyro's.
  explicit ImuIntake(Counters& counters, double max_rate = kMaxGyroRate_radps)
      : counters_(&counters), max_rate_(max_rate) {}

  enum class Step {
    kNone,      // they go on as those before
    kGap,       // a new stretch: after a long gap, or the clock was set forward
    kSetBack,   // a new stretch: the clock was set back
    kSetRight,  // a new stretch: the clock was set forward by what it had been set back
  };
  struct Result {
    std::vector<ImuSample> accepted;  // mostly one; several when a step is confirmed or denied
    Step step = Step::kNone;
  };
  Result Add(const ImuSample& sample);

 private:
  bool IsSane(const ImuSample& sample);
  double MeanStep_s() const;
  // Of a clock by which the sample that follows the newest one has that stamp.
  double ClockStepTo_s(Timestamp stamp) const;
  bool IsFar(Timestamp stamp) const;
  bool IsSuspect(const ImuSample& sample) const;
  bool MayBeSetRight(Timestamp stamp) const;
  bool Contradicts(const ImuSample& sample) const;
  // Those that are held are believed to be late, or not at all.
  std::vector<ImuSample> Release();
  Step Confirm();
  void Accept(const ImuSample& sample);

  Counters* counters_;
  double max_rate_;
  std::optional<Timestamp> newest_;
  double is_behind_s_ = 0.0;         // the clock, by steps back that were seen
  std::deque<ImuSample> recent_;     // accepted, by stamp
  std::vector<ImuSample> suspects_;  // perhaps of a new stretch of time, not yet believed
};

}  // namespace lio
