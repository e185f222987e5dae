// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/output_queue.hpp"

namespace lio {

void OutputQueue::Add(Output output) {
  if (is_muted_) {
    if (std::holds_alternative<NavOutput>(output)) return;
    if (auto* scan = std::get_if<ScanOutput>(&output)) scan->filter.reset();
  }
  outputs_.push_back(std::move(output));
}

void OutputQueue::Notify(Timestamp stamp, Notice::Severity severity, std::string text) {
  outputs_.emplace_back(std::in_place_type<Notice>, Notice{stamp, severity, std::move(text)});
}

void OutputQueue::NotifyWaiting(Timestamp stamp, std::string text) {
  const double since_s = SecondsBetween(last_waiting_, stamp);
  const bool was_clock_set_back = since_s < 0.0;
  if (!was_clock_set_back && since_s < kOutputQueue.waiting_every_s) return;
  last_waiting_ = stamp;
  Notify(stamp, Notice::Severity::kInfo, std::move(text));
}

}  // namespace lio
