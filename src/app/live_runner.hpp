// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator on a bus, with threads around it:
//
//   receive ---> inbox ---> filter ---> match (one job at a time, the map)
//                             ^  |  <------'
//                             |  '----> output (files, clouds, status)
//
// The queues and what they drop are described in filter_inbox.hpp, filter_loop.hpp and
// output_worker.hpp. Every drop is counted. The host's clock measures latency and paces the status;
// no estimate depends on it.
//
// An exception on one of the threads ends that thread. fault() then says so, and the owner calls
// Stop, which ends the other threads and completes the files with what had been estimated.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/command_desk.hpp"
#include "app/filter_inbox.hpp"
#include "app/filter_loop.hpp"
#include "app/input_watch.hpp"
#include "app/match_worker.hpp"
#include "app/output_worker.hpp"
#include "app/publisher.hpp"
#include "app/receiver.hpp"
#include "app/run_series.hpp"
#include "app/status_board.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/worker_thread.hpp"

namespace lio {

struct LiveOptions {
  Channels channels;
  std::string lcm_url;  // as told to people; empty for LCM's default
  std::string version;
  std::optional<std::filesystem::path> out;  // absent: no files
  std::filesystem::path next_out;            // later folders are numbered after this; empty: `out`
  bool writes_map = false;
  bool publishes_full_cloud = false;  // LIO_CMD may change it
  InitialMapPtr initial_map;          // null: the first scans begin a map
  Paths inputs;                       // files that were read: SAVE_MAP replaces none of them

  [[nodiscard]] StartIn start_in() const {
    return initial_map ? StartIn::kInitialMap : StartIn::kNewMap;
  }
  std::optional<int> socket;  // the status reports what the kernel drops there
  std::int32_t receive_buffer_bytes = 0;
  // How long Stop goes on matching the scans that wait.
  std::chrono::milliseconds max_finish{400};
  // It is called on the filter thread for each Ping, which a filter thread that hangs does not
  // answer.
  std::function<void()> answer_ping = [] {};
  ClockNs match_clock = ThreadCpuNs;  // for the stage times of matching; called on its thread
};

class LiveRunner {
 public:
  // `bus` is borrowed. Throws std::runtime_error when files cannot be created.
  LiveRunner(Bus& bus, const Options& options, const LiveOptions& live);
  ~LiveRunner();
  LiveRunner(const LiveRunner&) = delete;
  LiveRunner& operator=(const LiveRunner&) = delete;

  // Returns true when the bus will deliver nothing any more.
  [[nodiscard]] bool has_ended() const { return receiver_.has_ended(); }
  // Returns one line about the first thread that was ended by an exception; nothing when all is
  // well.
  [[nodiscard]] std::optional<std::string> fault() const { return faults_.first(); }
  // Feeders that must not overrun the matcher use it.
  [[nodiscard]] std::int64_t num_matches_done() const { return filter_.num_matches_done(); }
  // True once Stop has given up the scans that were still waiting.
  [[nodiscard]] bool is_cut_short() const { return filter_.is_cut_short(); }

  // Judges the whole run; absent before Stop, and where no message came.
  [[nodiscard]] const std::optional<Verdict>& verdict() const { return verdict_; }
  [[nodiscard]] bool writes_files() const { return files_.has_value(); }
  // Returns the folder of the files that are written now; null without any.
  [[nodiscard]] const std::filesystem::path* out() const {
    return files_ ? &files_->folder() : nullptr;
  }

  // From any thread: completes the files and goes on in a new folder, as the command NEW_FILES.
  void RenewFiles();
  void PingFilter() { inbox_.Put(Ping{}); }

  // Takes what has arrived, goes on matching the scans that wait for at most max_finish, completes
  // the files and sends a last status. It runs once only. Throws WriteError when a file could not
  // be written in full.
  void Stop();

 private:
  RunWriter* OpenFiles(const Options& options);
  void OnFault(const std::string& fault);
  void OnWriteFailure(const std::string& failure);
  void EndThreads();
  StatusReport ComposeStatus();
  void WatchInput(StatusReport& report);
  Account AccountAtEnd() const;  // once receiver and filter have ended
  RunStats Stats() const;
  RunStats JudgedStats() const;  // on the filter thread only

  const LiveOptions live_;
  Bus& bus_;
  const std::int64_t start_utime_;
  std::optional<RunSeries> files_;
  std::optional<Verdict> verdict_;
  Publisher publisher_;
  StatusBoard board_;
  OtherDaemons others_;
  InputWatch watch_;  // used by the output thread only
  FilterInbox inbox_;
  std::atomic<bool> has_account_ended_ = false;  // nothing is received or estimated any more
  FaultLatch faults_;
  MatchWorker match_worker_;
  OutputWorker output_worker_;
  FilterLoop filter_;
  CommandDesk desk_;
  Receiver receiver_;
  WorkerThread filter_thread_;
  WorkerThread receive_thread_;
};

}  // namespace lio
