// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/odometry_run.hpp"

#include <algorithm>
#include <utility>

#include "lio/io/beam_table.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/run_folder.hpp"
#include "python/errors.hpp"

namespace lio::python {

OdometryRun::OdometryRun(const Options& options, const RunSettings& settings)
    : settings_(settings),
      odometry_(options, ThreadCpuNs),
      worker_(options, ThreadCpuNs, BeamElevations(options.rig.lidar.model)),
      lidar_check_(options) {
  if (settings.out.empty()) return;
  RefuseEarlierRun(settings.out, settings.overwrites);
  try {
    writer_.emplace(settings.out, options);
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

void OdometryRun::Demand() const {
  if (is_finished_) throw UsageError("the run is finished; make another liod.Odometry");
  if (!refusal_.empty()) throw ConfigurationError(refusal_);
}

void OdometryRun::Note(Timestamp stamp) {
  first_ = std::min(first_.value_or(stamp), stamp);
  last_ = std::max(last_, stamp);
}

void OdometryRun::AddImu(const ImuSample& sample) {
  Demand();
  ++input_.num_imu_received;
  ++input_.num_imu_taken;
  Note(sample.stamp);
  odometry_.AddImu(sample);
  Match();
}

void OdometryRun::AddScan(ScanChunk chunk) {
  Demand();
  ++input_.num_chunks_received;
  ++input_.num_chunks_taken;
  Note(chunk.stamp);
  lidar_check_.Add(chunk);
  odometry_.AddChunk(std::move(chunk));
  Match();
}

void OdometryRun::AddUnnumbered(ScanChunk chunk) {
  constexpr std::int32_t kLastSeq = 2'000'000'000;  // as SynchronousOdometry counts
  chunk.scan_seq = next_seq_;
  next_seq_ = next_seq_ == kLastSeq ? 0 : next_seq_ + 1;
  AddScan(std::move(chunk));
}

void OdometryRun::Match() {
  while (const std::optional<MatchJob> job = odometry_.NextJob()) {
    if (settings_.keeps_map && job->map_action == MapAction::kClear) map_.Clear();
    const InsertTask insert = odometry_.FinishJob(worker_.Run(*job));
    worker_.Insert(insert);
    if (settings_.keeps_map && insert.T_map_imu) map_.Add(insert.points_imu, *insert.T_map_imu);
  }
  TakeOutputs();
  if (!refusal_.empty()) throw ConfigurationError(refusal_);
}

void OdometryRun::TakeOutputs() {
  for (const Output& output : odometry_.TakeOutputs()) {
    if (writer_) writer_->Write(output);
    if (const auto* notice = std::get_if<Notice>(&output)) {
      if (notice->severity == Notice::Severity::kError) refusal_ = notice->text;
      notices_.push_back(*notice);
      continue;
    }
    if (std::holds_alternative<NavOutput>(output) && !settings_.gives_imu_rate) continue;
    if (auto estimate = EstimateOf(output)) estimates_.push_back(std::move(*estimate));
  }
}

std::vector<Estimate> OdometryRun::TakeEstimates() {
  return std::exchange(estimates_, {});
}

Verdict OdometryRun::Judge() const {
  Verdict verdict = odometry_.Judge();
  lidar_check_.AddTo(verdict);
  return verdict;
}

void OdometryRun::Finish() {
  Demand();
  odometry_.Flush();
  Match();
  is_finished_ = true;
  if (writer_) WriteEnd();
}

void OdometryRun::WriteEnd() {
  if (settings_.keeps_map) writer_->WriteMap(map_.points_map());
  RunStats stats;
  stats.counters = odometry_.counters();
  stats.input = input_;
  stats.account.ledgers = odometry_.ledgers();
  stats.log_duration_s = first_ ? SecondsBetween(*first_, last_) : 0.0;
  stats.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  stats.verdict = Judge();
  stats.beams = worker_.FoundBeams();
  writer_->Finish(stats);
}

}  // namespace lio::python
