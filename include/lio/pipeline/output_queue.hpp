// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator's outputs in order, until the program takes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lio/pipeline/odometry.hpp"

namespace lio {

class OutputQueue {
 public:
  void Add(Output output) { outputs_.push_back(std::move(output)); }
  void Notify(Timestamp stamp, Notice::Severity severity, std::string text) {
    Add(Notice{stamp, severity, std::move(text)});
  }
  // Why something still waits; once a second of sensor time at most.
  void NotifyWaiting(Timestamp stamp, std::string text) {
    if (SecondsBetween(last_waiting_, stamp) < kWaitingEvery_s) return;
    last_waiting_ = stamp;
    Notify(stamp, Notice::Severity::kInfo, std::move(text));
  }
  [[nodiscard]] std::vector<Output> Take() { return std::exchange(outputs_, {}); }

 private:
  static constexpr double kWaitingEvery_s = 1.0;

  std::vector<Output> outputs_;
  Timestamp last_waiting_;
};

}  // namespace lio
