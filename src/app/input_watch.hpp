// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Watches whether messages come, whether scans are lost on the way, and whether another daemon
// publishes on the same channels, so that silence is said: what is wrong, and what to look at. Each
// fault is told once, and again only after it had passed.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "app/other_daemons.hpp"
#include "lio/io/status_report.hpp"

namespace lio {

// These are what a watch looks for, in the words of the one who must mend it.
struct InputNames {
  std::string imu, scan, status;  // channels
  std::string url;                // LCM's, not empty
  bool uses_imu = true;           // else nobody misses it
};

// An event of the watch: a fault has begun or has passed.
struct InputRemark {
  bool is_fault = true;
  std::string text;  // one line
};

class InputWatch {
 public:
  using Clock = std::chrono::steady_clock;

  // Silence of so long is a fault. Chosen: drivers that start together with liod have sent by then.
  static constexpr std::chrono::seconds kPatience{5};
  // A fault has passed when all was well for so long: one message in between is no recovery.
  static constexpr std::chrono::seconds kRecovery{3};
  // Time between two looks counts up to this: while the process was stopped nobody looked.
  static constexpr std::chrono::milliseconds kMaxStep{1500};

  InputWatch(InputNames names, Clock::time_point start)
      : names_(std::move(names)), last_look_(start) {}

  // To be called about once a second, with the counts since the start. Returns what is to be told
  // now.
  [[nodiscard]] std::vector<InputRemark> Look(const StatusReport& report,
                                              const OtherDaemons::Heard& others,
                                              Clock::time_point now);

  // Returns the faults that last, in one line; empty when all is well.
  [[nodiscard]] std::string standing() const;

 private:
  // Watches a count that ought to grow, or ought not to.
  struct Growth {
    std::int64_t count = 0;
    Clock::duration still_for{0};    // since it grew
    Clock::duration growing_for{0};  // since it last paused for more than kMaxStep
    bool Take(std::int64_t now_at, Clock::duration step);
  };
  struct Fault {
    bool lasts = false;
    std::string text;
  };

  void Judge(Fault& fault, bool begins, bool is_over, const std::string& text,
             std::vector<InputRemark>& remarks) const;
  [[nodiscard]] std::string SilenceText(const InputCounters& input) const;
  [[nodiscard]] std::string SecondDaemonText(std::int64_t start_utime) const;
  [[nodiscard]] std::string WhereToLook() const;

  InputNames names_;
  Clock::time_point last_look_;
  Growth imu_, chunks_;  // usable messages
  Growth kernel_drops_, scan_drops_;
  Growth others_;  // messages of other daemons
  Fault silence_, without_imu_, without_scans_, kernel_loss_, overload_, second_daemon_;
};

}  // namespace lio
