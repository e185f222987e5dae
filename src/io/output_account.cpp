// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_account.hpp"

#include <fmt/format.h>

namespace lio {
namespace {

std::string WhetherCloses(std::int64_t rest, const char* if_positive, const char* if_negative) {
  if (rest == 0) return "closes";
  return fmt::format("does not close by {}: {}", rest, rest > 0 ? if_positive : if_negative);
}

}  // namespace

std::int64_t StatusCounts::NumReceived() const {
  return counters.num_imu + counters.num_chunks + num_refused + num_queue_dropped;
}

void OutputAccount::Add(const std::string& channel, ByteView bytes) {
  if (channel == channels_.imu || channel == channels_.scan) ++tally_.num_inputs;
  if (channel == channels_.registration) ++tally_.num_rows;
  if (channel != channels_.status) return;
  const std::optional<StatusCounts> status = DecodeStatusCounts(bytes);
  if (!status) return;
  // Messages recorded before the start of a second daemon are none of its own.
  if (status_ && status->start_utime != status_->start_utime) {
    tally_.num_inputs -= at_status_.num_inputs;
    tally_.num_rows -= at_status_.num_rows;
  }
  status_ = status;
  at_status_ = tally_;
}

std::string OutputAccount::Text() const {
  if (!status_) return {};
  const Counters& c = status_->counters;
  std::string text = "\nThe last status of liod says:\n";
  if (at_status_.num_inputs > 0) {
    const std::int64_t num_received = status_->NumReceived();
    text += fmt::format(
        "  messages: {} recorded = {} used or refused by the estimator + {} refused as they came + "
        "{} dropped from the queue: {}\n",
        at_status_.num_inputs, c.num_imu + c.num_chunks, status_->num_refused,
        status_->num_queue_dropped,
        WhetherCloses(at_status_.num_inputs - num_received,
                      "messages were on the way, lost before liod, or sent before its start",
                      "the recorder lost messages or began later than liod"));
  }
  const std::int64_t num_lost =
      c.num_scans_empty + c.num_scans_dropped + c.num_scans_late + c.num_scans_without_imu;
  text += fmt::format(
      "  scans: {} closed = {} with a row + {} empty + {} dropped + {} late + {} without inertial "
      "samples: {}\n",
      c.num_scans, at_status_.num_rows, c.num_scans_empty, c.num_scans_dropped, c.num_scans_late,
      c.num_scans_without_imu,
      WhetherCloses(c.num_scans - at_status_.num_rows - num_lost,
                    "scans were before the start or wait for their match",
                    "the recorder began later than liod, or scans were counted twice"));
  return text;
}

}  // namespace lio
