// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator on a bus, with threads around it:
//
//   receive ---> inbox ---> filter ---> match (one job at a time, the map)
//                             ^  |  <------'
//                             |  '----> output (files, clouds, status)
//
// The filter thread alone touches the Odometry and publishes its small outputs at once. Queues and
// what they drop are in filter_inbox.hpp and output_worker.hpp; scans that wait for the match
// beyond pipeline.max_queued_scans are dropped oldest first. All drops are counted. The host's
// clock measures latency and paces the status; no estimate depends on it.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <thread>

#include "app/filter_inbox.hpp"
#include "app/match_worker.hpp"
#include "app/output_worker.hpp"
#include "app/publisher.hpp"
#include "app/receiver.hpp"
#include "app/status_board.hpp"

namespace lio {

struct LiveOptions {
  Channels channels;
  std::string version;
  std::optional<std::filesystem::path> out;  // absent: no files
  bool writes_map = false;
  bool publishes_full_cloud = false;  // LIO_CMD may change it
  std::optional<int> socket;          // whose kernel drops the status tells
  std::int32_t receive_buffer_bytes = 0;
};

class LiveRunner {
 public:
  // `bus` is borrowed. Throws std::runtime_error when files cannot be created.
  LiveRunner(Bus& bus, const Options& options, const LiveOptions& live);
  ~LiveRunner();
  LiveRunner(const LiveRunner&) = delete;
  LiveRunner& operator=(const LiveRunner&) = delete;

  // The bus will deliver nothing any more.
  bool has_ended() const { return receiver_.has_ended(); }
  // For feeders that must not overrun the matcher.
  std::int64_t num_matches_done() const { return num_matches_done_; }

  // Takes what has arrived, finishes the scans that are waiting, as far as that goes within half a
  // second, completes the files and sends a last status. Once only. Throws std::runtime_error when
  // a file could not be completed.
  void Stop();

 private:
  struct ScanTiming {
    std::int32_t scan_seq = -1;
    std::int64_t arrived_utime = 0;  // of its last chunk
    std::int64_t started_utime = 0;  // its match
  };

  void Filter();
  void Handle(Arrival<ImuSample>& arrival);
  void Handle(Arrival<ScanChunk>& arrival);
  void Handle(MatchOutcome& outcome);
  void HandOutJob();
  void Emit();
  void Emit(const ScanOutput& output);
  void Emit(const Notice& notice);
  void Obey(const Command& command);
  void EndThreads();
  ScanTiming& TimingOf(std::int32_t scan_seq);
  StatusReport ComposeStatus();
  RunStats Stats() const;

  const LiveOptions live_;
  const bool publishes_features_;
  Bus& bus_;
  std::optional<RunWriter> writer_;
  Publisher publisher_;
  StatusBoard board_;
  FilterInbox inbox_;

  // Of the filter thread.
  Odometry odometry_;
  bool has_job_out_ = false;
  std::int64_t decode_ns_ = 0;
  Timestamp newest_stamp_{0};
  std::int64_t first_utime_ = 0;
  std::int64_t last_utime_ = 0;
  std::optional<Timestamp> last_cloud_;
  FullCloudTask full_cloud_;                 // of the job that is out
  std::vector<Eigen::Vector3f> points_imu_;  // of the scan that was just fused, for LIO_CLOUD
  Pose T_map_points_;                        // where they are in the map
  std::array<ScanTiming, 64> timings_;       // of the last scans, by sequence
  TrackingStatus announced_ = TrackingStatus::kInit;
  std::string last_notice_;
  Timestamp last_notice_stamp_{0};

  std::atomic<bool> publishes_full_cloud_;
  std::atomic<bool> is_hurrying_ = false;  // no time for further scans
  std::atomic<std::int64_t> num_matches_done_ = 0;
  std::int64_t start_utime_;

  MatchWorker match_worker_;
  OutputWorker output_worker_;
  Receiver receiver_;
  std::promise<void> filter_done_;
  std::thread filter_thread_;
  std::thread receive_thread_;
};

}  // namespace lio
