// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter thread's work: feeds the Odometry from the inbox, hands jobs to the match thread, and
// publishes each output as soon as it is there. Only this thread touches the Odometry.
//
// When scans wait for the match beyond pipeline.max_queued_scans, the oldest are dropped and
// counted.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/filter_inbox.hpp"
#include "app/match_worker.hpp"
#include "app/notice_log.hpp"
#include "app/output_worker.hpp"
#include "app/publisher.hpp"
#include "app/scan_timings.hpp"
#include "app/status_board.hpp"
#include "lio/io/lidar_check.hpp"

namespace lio {

class FilterLoop {
 public:
  // The loop takes its items from these and gives its results to them. All are borrowed.
  struct Neighbours {
    FilterInbox& inbox;
    Publisher& publisher;
    StatusBoard& board;
    MatchWorker& match_worker;
    OutputWorker& output_worker;
    std::function<void(const Request&)> obey;  // called on the filter thread, between messages
    std::function<void()> answer_ping;         // likewise
  };

  FilterLoop(const Options& options, StartIn start_in, bool publishes_full_cloud,
             const Neighbours& neighbours);

  // Runs the thread's body until the inbox is closed and empty, and the job that is out has come
  // back.
  void Run();
  // From any thread: take no further messages and begin no further matches.
  void CutShort() { is_cut_short_ = true; }
  [[nodiscard]] bool is_cut_short() const { return is_cut_short_; }
  // Publishes LIO_CLOUD_FULL from the next scan on; any thread may call it.
  void PublishFullCloud(bool publishes) { publishes_full_cloud_ = publishes; }
  [[nodiscard]] std::int64_t num_matches_done() const { return num_matches_done_; }

  // Forgets all that is known (Odometry::Reset) and tells `why`. Runs on the filter thread.
  void Reset(const std::optional<GivenPose>& at, const std::string& why);

  // Call it after Run, or on the filter thread.
  [[nodiscard]] const Counters& counters() const { return odometry_.counters(); }
  [[nodiscard]] Verdict Judge() const;
  [[nodiscard]] Ledgers ledgers() const { return odometry_.ledgers(); }
  // Messages that were not looked at after CutShort.
  [[nodiscard]] const FilterInbox::Losses& given_up() const { return given_up_; }
  // Returns the host's time from the first message to the last.
  [[nodiscard]] double input_duration_s() const;

 private:
  // Holds the clouds of the scan that is being matched or was just fused.
  struct Clouds {
    FullCloudTask full;                       // for the job that is out
    std::vector<Eigen::Vector3f> points_imu;  // for LIO_CLOUD
    Pose T_map_points;                        // places points_imu in the map
    std::optional<Timestamp> last_sent;       // LIO_CLOUD
  };

  void Handle(Arrival<ImuSample>& arrival);
  void Handle(Arrival<ScanChunk>& arrival);
  void Handle(Request& request) { to_.obey(request); }
  void Handle(Ping&) { to_.answer_ping(); }
  void Handle(MatchOutcome& outcome);
  void NoteArrival(std::int64_t recv_utime, Timestamp stamp);
  void HandOutJob();
  void GoOn();
  void Emit();
  void Emit(const ScanOutput& output);
  void EmitClouds(const ScanOutput& output);

  Neighbours to_;
  Odometry odometry_;
  LidarCheck lidar_check_;
  const bool publishes_features_;
  std::atomic<bool> publishes_full_cloud_;
  std::atomic<bool> is_cut_short_ = false;
  std::atomic<std::int64_t> num_matches_done_ = 0;

  FilterInbox::Losses given_up_;
  bool has_job_out_ = false;
  std::int64_t decode_ns_ = 0;  // CPU time of decoding inertial samples since the last scan
  Timestamp newest_stamp_{0};
  std::int64_t first_utime_ = 0;
  std::int64_t last_utime_ = 0;
  Clouds clouds_;
  ScanTimings timings_;
  NoticeLog notices_;
  TrackingStatus announced_ = TrackingStatus::kInit;
};

}  // namespace lio
