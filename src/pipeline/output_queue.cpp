// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/output_queue.hpp"

#include <algorithm>

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
  const double unasked_s = wait_ ? SecondsBetween(wait_->asked, stamp) : 0.0;
  const bool was_clock_set_back = unasked_s < 0.0;
  if (was_clock_set_back || unasked_s > kOutputQueue.waiting_ends_s) wait_.reset();
  if (!wait_) {
    wait_ = Wait{.asked = stamp, .told = stamp};
  } else {
    wait_->asked = stamp;
    if (SecondsBetween(wait_->told, stamp) < wait_->next_s) return;
    wait_->told = stamp;
    wait_->next_s = std::min(2.0 * wait_->next_s, kOutputQueue.max_waiting_s);
  }
  Notify(stamp, Notice::Severity::kInfo, std::move(text));
}

}  // namespace lio
