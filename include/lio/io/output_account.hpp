// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds what a recording has of liod's inputs and outputs against the counts of its last status:
// whether every recorded message arrived, whether every scan that was matched has a row, and
// whether the account of the status closes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/io/account.hpp"

namespace lio {

// The counts of messages in a message of LIO_STATUS.
struct StatusCounts {
  std::int64_t start_utime = 0;  // when the daemon started
  Counters counters;             // without ledgers
  std::int64_t num_refused = 0;
  std::int64_t num_queue_dropped = 0;
  std::vector<AccountPage> account = AccountPages({}, {});

  // Messages of the two input channels that the daemon knows of.
  [[nodiscard]] std::int64_t NumReceived() const;
};

// It is absent where the bytes are no status_t of this version.
[[nodiscard]] std::optional<StatusCounts> DecodeStatusCounts(ByteView bytes);

class OutputAccount {
 public:
  explicit OutputAccount(const Channels& channels) : channels_(channels) {}

  void Add(const std::string& channel, ByteView bytes);
  // Lines for people; empty where the recording has no status.
  [[nodiscard]] std::string Text() const;

 private:
  struct Tally {
    std::int64_t num_inputs = 0;
    std::int64_t num_rows = 0;
  };

  Channels channels_;
  std::optional<StatusCounts> status_;
  Tally tally_;      // since the recording began, or since the daemon was started again
  Tally at_status_;  // as of the last status
};

}  // namespace lio
