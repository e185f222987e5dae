// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does what commands ask for, or refuses, and answers each on LIO_REPLY with its request_id.
#pragma once

#include <functional>
#include <string>

#include "app/filter_loop.hpp"
#include "app/run_series.hpp"
#include "lio/io/input_guard.hpp"

namespace lio {

class CommandDesk {
 public:
  // Whom it tells to do things. All are borrowed.
  struct Neighbours {
    Publisher& publisher;
    StatusBoard& board;
    MatchWorker& match_worker;
    OutputWorker& output_worker;
    FilterLoop& filter;
  };
  // The arguments of the daemon decide what can be asked for.
  struct Setting {
    RunSeries* files = nullptr;  // null: no --out; of the output thread
    bool collects_map = false;
    bool has_initial_map = false;
    Paths inputs;  // no map is saved over them
  };

  // `make_stats` is called on the filter thread: what was counted so far, with the verdict.
  // `on_write_failure` is called on the output thread.
  CommandDesk(const Neighbours& neighbours, const Setting& setting,
              std::function<RunStats()> make_stats, OnFault on_write_failure);

  // Runs on the filter thread, between two messages.
  void Obey(const Request& request);
  // Any thread may call it.
  void Refuse(const Command& command, const std::string& why);

 private:
  [[nodiscard]] std::string WhyNotNow(const Command& command) const;
  void Do(const Request& request);
  void Reset(const Request& request);
  void RenewFiles(const Request& request);
  void SaveMap(const Request& request);
  void Answer(const Request& request, bool is_done, const std::string& text);

  Neighbours to_;
  Setting setting_;
  std::function<RunStats()> make_stats_;
  OnFault on_write_failure_;
};

}  // namespace lio
