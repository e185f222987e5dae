// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator; this is the first file to read. It is a single-threaded state machine that
// takes samples and chunks in the order they arrive and returns outputs. Matching a scan is handed
// out as a job, so that a daemon can run it on another thread while the filter goes on:
//
//   odometry.AddImu(sample); odometry.AddChunk(chunk);           // filter thread
//   while (auto job = odometry.NextJob()) {                      // at most one job in flight
//     MatchOutcome outcome = matching.Run(*job);                 // any one thread
//     InsertTask insert = odometry.FinishJob(std::move(outcome));  // filter thread
//     matching.Insert(insert);                                   // before the next Run
//   }
//   for (auto& output : odometry.TakeOutputs()) ...
//
// The estimate for a scan depends only on the messages and their order, never on when a job is
// finished: replay and live agree to the last bit (docs/design.md).
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "lio/base/notice.hpp"
#include "lio/base/pose.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/pipeline/outputs.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

// CPU clock for stage times; the core has none of its own. Null: no times.
using ClockNs = std::int64_t (*)();

struct MatchJob;      // match_job.hpp
struct MatchOutcome;  // match_job.hpp
struct InsertTask;    // match_job.hpp
struct FoundSensors;  // found_sensors.hpp

// Reports one accepted scan: rows of the trajectories, covariances and registration.csv. `filter`
// is absent before the start.
struct ScanOutput {
  std::optional<FilterReport> filter;
  ScanReport scan;
  Trust trust = Trust::kYes;  // in the result so far, at the last look at the rig
};

using Output = std::variant<ScanOutput, NavOutput, Notice>;

// Tells which map the first scans go into: their own, or one that the registration worker was
// given.
enum class StartIn : std::int8_t { kNewMap, kInitialMap };

// Holds a pose of the body that somebody else knows.
struct GivenPose {
  Pose T_world_imu;
  // [position in world (m); right rotation error (rad)]; the least that a start has is added.
  Matrix6 cov = Matrix6::Zero();
};

class Odometry {
 public:
  // Throws std::invalid_argument naming every fault of the options. `found`: by a pass before over
  // the same messages; null where this is the first.
  explicit Odometry(const Options& options, ClockNs clock = nullptr,
                    StartIn start_in = StartIn::kNewMap, const FoundSensors* found = nullptr);
  ~Odometry();
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;

  void AddImu(const ImuSample& sample);
  // `decode_ns`: CPU time that decoding the message took, for the stage times.
  void AddChunk(ScanChunk chunk, std::int64_t decode_ns = 0);
  // Forgets the motion, the map and what was learned of the sensors: what follows depends on the
  // messages that follow alone, as in a new Odometry with a new RegistrationWorker, which the
  // caller makes. Counters go on; outputs that were not taken and scans that wait are lost. The
  // outcome of a job that is out is still to be given to FinishJob, and has no effect. A pose
  // places the new world so that the body is there when `stamp` is; with gravity only position and
  // yaw of it count.
  void Reset(const std::optional<GivenPose>& at = std::nullopt, Timestamp stamp = {});
  // The log has ended: closes what is still open.
  void Flush();

  [[nodiscard]] std::optional<MatchJob> NextJob();
  [[nodiscard]] InsertTask FinishJob(MatchOutcome outcome);

  // Live only: drops the oldest waiting scans beyond options.pipeline.max_queued_scans, counted.
  void ShedLoad();

  // Everything that happened since the last call, in order. NavOutputs of source kImuPropagated
  // come one an IMU sample.
  [[nodiscard]] std::vector<Output> TakeOutputs();

  [[nodiscard]] const Counters& counters() const;
  // The fates of every sample, chunk and scan so far, with those that wait now.
  [[nodiscard]] Ledgers ledgers() const;
  [[nodiscard]] TrackingStatus status() const;
  // May the result so far be trusted, and if not, why? Counts the outputs that TakeOutputs() has
  // given. Costs some ten milliseconds.
  [[nodiscard]] Verdict Judge() const;
  // Returns what the messages so far tell of the sensors, for another pass over them.
  [[nodiscard]] FoundSensors found_sensors() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
