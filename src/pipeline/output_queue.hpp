// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Queues the estimator's outputs in order, until the program takes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lio/pipeline/odometry.hpp"

namespace lio {

struct OutputQueueParameters {
  double waiting_every_s = 1.0;  // between notices of waiting; chosen: a person reads no faster
};

inline constexpr OutputQueueParameters kOutputQueue;

class OutputQueue {
 public:
  void Add(Output output);
  // While muted, poses are left out: reports of matches and notices pass.
  void Mute(bool is_muted) { is_muted_ = is_muted; }
  void Notify(Timestamp stamp, Notice::Severity severity, std::string text);
  // Says why something still waits; once a second of sensor time at most.
  void NotifyWaiting(Timestamp stamp, std::string text);
  [[nodiscard]] std::vector<Output> Take() { return std::exchange(outputs_, {}); }

 private:
  std::vector<Output> outputs_;
  Timestamp last_waiting_;
  bool is_muted_ = false;
};

}  // namespace lio
