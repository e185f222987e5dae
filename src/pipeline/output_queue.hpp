// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Queues the estimator's outputs in order, until the program takes them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lio/pipeline/odometry.hpp"

namespace lio {

struct OutputQueueParameters {
  // s. The second notice of a wait follows the first one after so long, and each further one twice
  // as long after the one before. Chosen: a person reads no faster, and half a minute tells whether
  // a program still waits.
  double second_waiting_s = 1.0;
  double max_waiting_s = 32.0;
  // s. The wait is over once nothing says for so long that it goes on. Chosen: ten sweeps.
  double waiting_ends_s = 1.0;
};

inline constexpr OutputQueueParameters kOutputQueue;

class OutputQueue {
 public:
  void Add(Output output);
  // While muted, poses are left out: reports of matches and notices pass.
  void Mute(bool is_muted) { is_muted_ = is_muted; }
  void Notify(Timestamp stamp, Notice::Severity severity, std::string text);
  // Says why something still waits, to be called at each scan that it does: the longer it waits,
  // the less often it is said. All times are of the sensors.
  void NotifyWaiting(Timestamp stamp, std::string text);
  [[nodiscard]] std::vector<Output> Take() { return std::exchange(outputs_, {}); }

 private:
  std::vector<Output> outputs_;
  struct Wait {
    Timestamp asked;  // when NotifyWaiting() was last called
    Timestamp told;
    double next_s = kOutputQueue.second_waiting_s;  // after `told`
  };
  std::optional<Wait> wait_;
  bool is_muted_ = false;
};

}  // namespace lio
