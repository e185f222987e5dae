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

// Fates that no message had are left out.
std::string PageText(const AccountPage& page) {
  std::string fates;
  for (std::size_t i = 1; i < page.entries.size(); ++i) {
    const AccountEntry& entry = page.entries[i];
    if (entry.count == 0) continue;
    fates += fmt::format("{}{} {}", fates.empty() ? "" : " + ", entry.count, entry.name);
  }
  return fmt::format("  {}: {} received = {}: {}\n", page.name, page.num_received(),
                     fates.empty() ? "0" : fates,
                     WhetherCloses(page.Unaccounted(), "they have no fate; please report this",
                                   "they have two fates; please report this"));
}

// Scans that were matched have a row each.
std::int64_t NumRowsDue(const StatusCounts& status) {
  std::int64_t num = 0;
  for (const AccountEntry& entry : status.account.back().entries) {
    if (entry.name == kScanFateNames[static_cast<std::size_t>(ScanFate::kUsed)] ||
        entry.name == kScanFateNames[static_cast<std::size_t>(ScanFate::kRejected)]) {
      num += entry.count;
    }
  }
  return num;
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
  if (at_status_.num_rows > 0) {
    const std::int64_t num_due = NumRowsDue(*status_);
    text += fmt::format(
        "  rows: {} recorded of {} scans that were matched: {}\n", at_status_.num_rows, num_due,
        WhetherCloses(num_due - at_status_.num_rows,
                      "the recorder lost rows or began later than liod", "scans have two rows"));
  }
  for (const AccountPage& page : status_->account) text += PageText(page);
  return text;
}

}  // namespace lio
