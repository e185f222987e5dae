// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Puts right the stamps of a lidar whose clock was set while the IMU's was not. Both streams come
// through one queue, so that the order of messages tells: a chunk comes a steady while after the
// inertial samples of its time. When chunks keep coming as often as before, and the stamps of all
// of them lie elsewhere against the inertial stream from one on, their clock was set, and their
// stamps are shifted back. Chunks are held while that is in doubt, for a quarter of a second.
// A lidar that paused, and one whose messages come late, is left alone. No wall clock is asked.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

class LidarClockCorrector {
 public:
  struct Arrival {
    ScanChunk chunk;
    std::int64_t decode_ns = 0;
  };
  // Takes a chunk that came when the inertial stream was at `newest_imu`. Returns the chunks that
  // may go on, in the order in which they came, with stamps put right.
  [[nodiscard]] std::vector<Arrival> Add(Arrival arrival, Timestamp newest_imu);
  // The inertial clock is in doubt itself, or there is none. Chunks that are held go on as they
  // came, and nothing is known of the streams' order any more.
  [[nodiscard]] std::vector<Arrival> Release();
  // Does the same with a chunk behind them.
  [[nodiscard]] std::vector<Arrival> Release(Arrival arrival);

  // Puts a stamp right that does not pass through here.
  Timestamp PutRight(Timestamp stamp) const { return stamp + shift_; }
  // Returns how long after the inertial samples of their last points chunks come, as known last;
  // zero before the first one.
  Duration late_by() const { return late_by_; }
  // Returns the stamp of the newest chunk that went on.
  Timestamp newest() const { return newest_; }
  std::size_t num_held() const { return held_.size(); }

  struct Step {
    Timestamp stamp;  // stamp of the first chunk after it, put right
    Duration by;      // change of the lidar's clock
    Duration shift;   // shift of its stamps from here on
  };
  // Returns the step that the last call of Add() has found, once.
  [[nodiscard]] std::optional<Step> TakeStep() { return std::exchange(step_, std::nullopt); }

 private:
  // One message of a burst stands for all of it.
  struct Sight {
    Duration lag;      // how far its stamp lies behind the inertial stream
    Duration stride;   // advance of the inertial stream since the one before
    Duration late_by;  // how far the last point in it does, which is nearly the latest
  };
  enum class Judgement { kSteady, kUnclear, kStepped };

  [[nodiscard]] Judgement Judge(const ScanChunk& chunk, Timestamp newest_imu);
  [[nodiscard]] Judgement JudgeElsewhere(const Sight& sight, Timestamp newest_imu);
  [[nodiscard]] bool HasHeldTooLong() const;
  [[nodiscard]] std::vector<Arrival> GiveOut();
  void ShiftBack();
  void Forget();
  Duration Usual(Duration Sight::*quantity) const;
  Duration UsualLag() const { return Usual(&Sight::lag); }
  bool HasPaused(const Sight& sight) const;
  bool IsElsewhere(Duration lag, Duration from) const;

  std::deque<Sight> known_;          // by the clock as it was; the last few
  Duration late_by_;                 // as they are usually
  std::vector<Duration> elsewhere_;  // lags behind a step that is in doubt
  Timestamp elsewhere_since_;        // by the inertial stream
  std::optional<Timestamp> newest_imu_;
  Duration shift_;
  Timestamp newest_;
  std::vector<Arrival> held_;
  std::optional<Step> step_;
};

}  // namespace lio
