// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Statistics of a sensor's stream in bounded memory: rate, span, gaps and delays, and for an IMU
// the unit of its accelerometer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Returns the stamp of an event in a log; a time more than 146 years from the epoch, which is
// damage, is moved there, so that differences of two do not overflow.
[[nodiscard]] Timestamp ReceiveStamp(std::int64_t utime);

class StreamStats {
 public:
  void Add(Timestamp stamp, Timestamp received);

  std::int64_t num() const { return num_; }
  std::optional<Timestamp> first_stamp() const { return first_; }
  std::optional<Timestamp> last_stamp() const { return last_; }
  [[nodiscard]] double rate_hz() const;  // one over the typical period; 0 for less than two samples
  [[nodiscard]] double span_s() const;   // last stamp minus first
  [[nodiscard]] std::int64_t num_gaps() const;  // periods over three times the typical one
  double longest_gap_s() const { return longest_s_; }
  std::int64_t num_backwards() const { return num_backwards_; }  // stamps not above the last one
  [[nodiscard]] double mean_delay_s() const;                     // receive time minus stamp

 private:
  [[nodiscard]] double TypicalPeriod() const;  // median of the first periods

  std::int64_t num_ = 0;
  std::optional<Timestamp> first_;
  std::optional<Timestamp> last_;
  std::vector<double> first_periods_s_;  // at most kNumFirst
  std::int64_t num_gaps_after_ = 0;      // among the periods that are not kept
  double longest_s_ = 0.0;
  std::int64_t num_backwards_ = 0;
  double delay_sum_s_ = 0.0;
  std::optional<double> typical_s_;  // once kNumFirst periods are in
};

// Judges the unit of an accelerometer from its quietest second.
class AccelerometerStats {
 public:
  void Add(const ImuSample& sample);

  [[nodiscard]] double mean_mps2() const;        // mean norm of all samples
  [[nodiscard]] double quiet_mean_mps2() const;  // mean norm in the quietest second
  double largest_rate_radps() const { return largest_rate_; }
  std::int64_t num_nonfinite() const { return num_nonfinite_; }
  // Returns "specific force in m/s^2, gravity present", or what the samples look like instead and
  // what to do.
  [[nodiscard]] std::string Suggestion() const;

 private:
  struct Window {
    std::int64_t num = 0;
    double sum = 0.0;
    double sum_sq = 0.0;
  };
  void CloseWindow();

  Window all_;
  Window window_;
  std::optional<Timestamp> window_begin_;
  double quiet_mean_ = 0.0;
  double quiet_variance_ = -1.0;  // negative: no second is complete
  double largest_rate_ = 0.0;
  std::int64_t num_nonfinite_ = 0;
};

}  // namespace lio
