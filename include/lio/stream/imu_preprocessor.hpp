// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decides what to believe of the inertial stream before anything is integrated: drops what is not
// finite or out of range, and holds samples whose stamp jumps until the samples after them say
// whether one stamp was wrong, whether they are merely late, or whether the clock was set. Only
// stamps decide, never the wall clock.
//
// Late samples fill a hole in the stream; those of a clock that was set back by less than a second
// tell of a time that others have told of already. A step back of less than 80 ms or five
// samples is not seen: those samples are dropped as repeats or mixed in; nor is one where samples
// come in bursts, so that holes are everywhere.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/imu/imu_convention.hpp"

namespace lio {

class ImuPreprocessor {
 public:
  // Counts into `counters`, which outlives this. Rates beyond `max_rate`, in the samples' unit, are
  // no gyro's.
  explicit ImuPreprocessor(Counters& counters, double max_rate = kMaxGyroRate_radps)
      : counters_(&counters), max_rate_(max_rate) {}

  enum class Step {
    kNone,      // they go on as those before
    kHole,      // less than a second is missing, or the clock was set forward
    kGap,       // more than that
    kSetBack,   // the clock was set back
    kSetRight,  // the clock was set forward by what it had been set back
  };
  struct Result {
    std::vector<ImuSample> accepted;  // mostly one; several when a step is confirmed or denied
    Step step = Step::kNone;
    Timestamp before;           // with a step: the newest stamp before it
    double clock_step_s = 0.0;  // with a step: of the clock, if samples went on meanwhile
    bool undoes_hole = false;   // the step back is as long as a hole before: was that a step, too?
  };
  [[nodiscard]] Result Add(const ImuSample& sample);
  // Counts samples that wait until others bear them out.
  std::size_t num_held() const { return suspects_.size(); }
  // Are samples held that may be the first ones after a step?
  bool is_in_doubt() const { return !suspects_.empty(); }
  // Returns the samples that are still held, when no more will come.
  [[nodiscard]] std::vector<ImuSample> Flush();
  // Only right after a step: `shift` is added to the stamps of what was accepted with it.
  void ShiftBy(Duration shift);
  // The last hole in the stream was none of the clock's doing.
  void ForgetHole();
  std::optional<Timestamp> newest() const { return newest_; }

 private:
  bool IsSane(const ImuSample& sample);
  double MeanStep_s() const;
  // Returns the step of a clock by which the sample that follows the newest one has that stamp.
  double ClockStepTo_s(Timestamp stamp) const;
  bool IsFar(Timestamp stamp) const;
  bool IsBehindHole(Timestamp stamp) const;
  bool IsSuspect(const ImuSample& sample) const;
  bool MayBeSetRight(Timestamp stamp) const;
  bool Contradicts(const ImuSample& sample) const;
  // Those that are held are believed, unless they are far off.
  std::vector<ImuSample> Release();
  Result Confirm();
  void Accept(const ImuSample& sample);

  Counters* counters_;
  double max_rate_;
  std::optional<Timestamp> newest_;
  double is_behind_s_ = 0.0;         // the clock, by steps back that were seen
  double hole_s_ = 0.0;              // the last one in the stream; perhaps a step forth
  Timestamp step_after_;             // stamp of the first sample after the last step
  std::deque<ImuSample> recent_;     // accepted, by stamp
  std::vector<ImuSample> suspects_;  // perhaps of a new segment, not yet believed
};

}  // namespace lio
