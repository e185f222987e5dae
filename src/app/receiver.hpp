// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The receive thread: takes messages from the bus, decodes them (one bounded copy, no computing)
// and puts them into the filter's inbox.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "app/filter_inbox.hpp"
#include "app/other_daemons.hpp"
#include "app/status_board.hpp"
#include "lio/io/bus.hpp"

namespace lio {

class Receiver {
 public:
  // Gives the answer to a command that nobody takes, and why; on the receive thread.
  using Refuse = std::function<void(const Command&, const std::string& why)>;

  // Subscribes to the input channels, and to LIO_STATUS for other daemons. All references are
  // borrowed.
  Receiver(Bus& bus, const Channels& channels, ClockNs clock, FilterInbox& inbox,
           StatusBoard& board, OtherDaemons& others, Refuse refuse);

  // Runs the thread's body until Stop, or until the bus is closed. After Stop it still takes the
  // messages that have arrived, for 200 ms at most, so that the last scan of a log is not lost.
  void Run();
  void Stop() { is_stopping_ = true; }

  [[nodiscard]] bool has_ended() const {
    return has_ended_;
  }  // the bus is closed: nothing will come any more

 private:
  void OnImu(ByteView data, std::int64_t recv_utime);
  void OnScan(ByteView data, std::int64_t recv_utime);
  void OnCommand(ByteView data);
  void Drain();
  void ReportCounters();

  Bus& bus_;
  ClockNs clock_;
  FilterInbox& inbox_;
  StatusBoard& board_;
  Refuse refuse_;
  InputDecoder decoder_;
  std::int64_t num_oversized_ = 0;  // messages of the bus that are counted already
  std::atomic<bool> is_stopping_ = false;
  std::atomic<bool> has_ended_ = false;
};

}  // namespace lio
