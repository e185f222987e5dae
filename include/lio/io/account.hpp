// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Composes the account of a run: what became of every message and scan, from the bytes that came to
// the estimate. It closes, or says by how much it does not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/ledger.hpp"
#include "lio/io/input_decoder.hpp"

namespace lio {

// Counts messages between the decoder and the estimator; all are zero in a replay.
struct TransitCounters {
  std::int64_t num_dropped = 0;   // the queue was full
  std::int64_t num_given_up = 0;  // the daemon had to end before they were looked at
  std::int64_t num_waiting = 0;

  TransitCounters& operator-=(const TransitCounters& begin) {
    num_dropped -= begin.num_dropped;
    num_given_up -= begin.num_given_up;
    num_waiting -= begin.num_waiting;
    return *this;
  }
};

struct Account {
  Ledgers ledgers;  // the estimator's, with what still waits
  TransitCounters imu;
  TransitCounters chunks;
};

struct AccountEntry {
  std::string_view name;
  std::int64_t count = 0;
};

// Lists what was received, and then every fate, what waits among them.
struct AccountPage {
  std::string_view name;
  std::vector<AccountEntry> entries;

  [[nodiscard]] std::int64_t num_received() const { return entries.front().count; }
  // Returns zero when the page closes.
  [[nodiscard]] std::int64_t Unaccounted() const;
};

// Returns the pages "imu", "chunks" and "scans", in the order of stats.json and of status_t.
[[nodiscard]] std::vector<AccountPage> AccountPages(const Account& account,
                                                    const InputCounters& input);

// Returns the object "account" of stats.json, without its key.
[[nodiscard]] std::string AccountJson(const Account& account, const InputCounters& input);

// Returns the number of samples, chunks and scans that were received but have no fate, in a
// sentence; empty when the account closes.
[[nodiscard]] std::string WhyOpen(const Account& account, const InputCounters& input);

}  // namespace lio
