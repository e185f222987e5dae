// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/odometry.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "lio/base/chi_square.hpp"
#include "lio/pipeline/found_sensors.hpp"
#include "pipeline/convention_causes.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/mode_driver.hpp"
#include "pipeline/sweep_queue.hpp"

namespace lio {
namespace {

const Options& Validated(const Options& options) {
  const std::vector<OptionFault> faults = Validate(options);
  if (faults.empty()) return options;
  std::string text = "unusable options:";
  for (const OptionFault& fault : faults) text += " " + fault.key + ": " + fault.message + ";";
  throw std::invalid_argument(text);
}

// Returns what is known of the clocks beyond the offset that WithFound puts into the rig.
ClockBelief BeyondRig(ClockBelief clock) {
  clock.mean[0] = 0.0;
  return clock;
}

bool IsLeverFound(const Rig& rig, const FoundSensors& found) {
  const Vector3 given = rig.T_imu_lidar ? rig.T_imu_lidar->translation : Vector3::Zero();
  return found.T_imu_lidar && found.T_imu_lidar->translation != given;
}

StreamOptions MakeStreamOptions(const Options& options, const FoundSensors& found) {
  StreamOptions stream;
  stream.use_imu = options.pipeline.use_imu;
  stream.units = options.rig.imu.units;
  stream.convention = found.convention;
  stream.lidar_clock_offset_s = options.rig.lidar.clock_offset_s;
  // Live, sweeps that wait for matching are dropped before so many do.
  if (options.filter.estimate_clock_offset && options.pipeline.use_imu) {
    stream.max_unmatched = static_cast<std::size_t>(options.pipeline.max_queued_scans) + 3;
  }
  stream.incomplete_sweep_wait_s = options.pipeline.incomplete_sweep_wait_s;
  return stream;
}

}  // namespace

// Holds the parts of the estimator. All but the mode outlive every mode.
struct Odometry::Impl {
  Impl(const Options& given, ClockNs given_clock, StartIn given_start_in,
       const FoundSensors& found = {}, const Handover& handover = {})
      : options(WithFound(Validated(given), found)),
        clock(given_clock),
        start_in(given_start_in),
        stream(MakeStreamOptions(options, found), counters),
        queue(static_cast<std::size_t>(options.pipeline.max_queued_scans)),
        convention(options.rig, stream.imu()),
        examiner(options.rig, options.pipeline.use_imu, IsLeverFound(given.rig, found)),
        clocks(options, BeyondRig(found.clock)),
        extrinsic(options, found.extrinsic_std),
        place(start_in == StartIn::kInitialMap, options.pipeline.map_locked),
        mode({.options = options,
              .nis_limit = ChiSquareQuantile6(options.filter.gate_probability),
              .clock = clock,
              .counters = counters,
              .outputs = outputs,
              .stream = stream,
              .sweeps = queue.sweeps(),
              .convention = convention,
              .clocks = clocks,
              .extrinsic = extrinsic,
              .imu_noise = imu_noise,
              .imu_rate = imu_rate,
              .stuck_imu = stuck_imu,
              .sensor_errors = sensor_errors,
              .blind_axis = blind_axis,
              .examiner = examiner,
              .place = place},
             place, handover) {
    if (found.convention) examiner.SetConvention(*found.convention);
  }

  std::int64_t NowNs() const { return clock == nullptr ? 0 : clock(); }

  // Events go to the mode one by one, since each may change which one comes next.
  void ConsumeEvents() {
    std::size_t num_sweeps = 0;
    while (const std::optional<StreamEvent> event = NextEvent()) {
      if (std::holds_alternative<SweepReady>(*event)) ++num_sweeps;
      mode.Consume(*event);
    }
    queue.AddSetFree(num_sweeps);
  }
  std::optional<StreamEvent> NextEvent() {
    stream.SetStampCorrection(clocks.correction());
    return stream.Next(queue.NumUnmatched(mode.next_sweep()));
  }

  Options options;
  ClockNs clock;
  StartIn start_in;
  Counters counters;
  OutputQueue outputs;
  SensorStream stream;
  SweepQueue queue;
  ImuConventionMonitor convention;
  ImuNoiseWatch imu_noise;
  ImuRateWatch imu_rate;
  StuckImuDetector stuck_imu;
  SensorFixedErrors sensor_errors;
  BlindAxis blind_axis;
  RigExaminer examiner;
  ClockOffsetFollower clocks;
  ExtrinsicFollower extrinsic;
  PlaceKnowledge place;
  ModeDriver mode;
  std::int64_t filter_ns = 0;  // CPU time of the filter since the last job
};

Odometry::Odometry(const Options& options, ClockNs clock, StartIn start_in,
                   const FoundSensors* found)
    : impl_(std::make_unique<Impl>(options, clock, start_in,
                                   found == nullptr ? FoundSensors{} : *found)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

void Odometry::AddImu(const ImuSample& sample) {
  const std::int64_t begin_ns = impl_->NowNs();
  impl_->stream.AddImu(sample);
  impl_->examiner.tally().AddImu(sample.stamp);
  impl_->ConsumeEvents();
  impl_->filter_ns += impl_->NowNs() - begin_ns;
}

void Odometry::AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
  impl_->stream.AddChunk(std::move(chunk), decode_ns);
  impl_->ConsumeEvents();
}

void Odometry::Reset(const std::optional<GivenPose>& at, Timestamp stamp) {
  Handover handover;
  if (at) {
    handover.origin = Handover::Origin::kInertial;
    handover.is_placed = true;
    handover.last_fix = {.stamp = stamp,
                         .T_world_imu = at->T_world_imu,
                         .T_map_imu = at->T_world_imu,
                         .pose_cov = at->cov};
    handover.pose_cov = at->cov;
  }
  auto next = std::make_unique<Impl>(impl_->options, impl_->clock, impl_->start_in, FoundSensors{},
                                     handover);
  next->counters = impl_->counters;
  Ledgers& kept = next->counters.ledgers;
  kept = ledgers();
  kept.samples.ForgetWaiting();
  kept.chunks.ForgetWaiting();
  kept.scans.ForgetWaiting();
  ++next->counters.num_restarts;
  impl_ = std::move(next);
}

void Odometry::Flush() {
  impl_->stream.Flush();
  impl_->ConsumeEvents();
}

std::optional<MatchJob> Odometry::NextJob() {
  const SweepPtr sweep = impl_->queue.StartNext(impl_->mode.next_sweep());
  if (!sweep) return std::nullopt;
  const std::int64_t begin_ns = impl_->NowNs();
  MatchJob job = impl_->mode.MakeJob(sweep);
  job.filter_ns = std::exchange(impl_->filter_ns, 0) + impl_->NowNs() - begin_ns;
  return job;
}

InsertTask Odometry::FinishJob(MatchOutcome outcome) {
  InsertTask insert;
  impl_->counters.num_points_nonfinite += outcome.num_nonfinite;
  if (impl_->queue.Finish(outcome.sweep, impl_->mode.next_sweep())) {
    insert = impl_->mode.FinishJob(outcome);
    insert.points_imu = std::move(outcome.points_imu);
    insert.points_lidar = std::move(outcome.points_lidar);
    insert.tags = std::move(outcome.tags);
  }
  impl_->ConsumeEvents();
  return insert;
}

void Odometry::ShedLoad() {
  const bool looks_back = impl_->mode.kind() == ModeKind::kInitializing;
  const std::size_t num_shed = impl_->queue.Shed(impl_->mode.next_sweep(), looks_back);
  impl_->counters.num_scans_dropped += static_cast<std::int64_t>(num_shed);
  impl_->counters.ledgers.scans.Settle(ScanFate::kDropped, num_shed);
}

std::vector<Output> Odometry::TakeOutputs() {
  std::vector<Output> outputs = impl_->outputs.Take();
  for (const Output& output : outputs) {
    const auto* scan = std::get_if<ScanOutput>(&output);
    if (scan != nullptr && scan->filter) {
      impl_->examiner.tally().AddRow(MakePoseRow(*scan->filter));
    }
  }
  return outputs;
}

Verdict Odometry::Judge() const {
  std::vector<Cause> suspected;
  if (const auto convention = impl_->convention.Suspected()) {
    suspected = ConventionCauses(
        *convention, impl_->options.rig, Trust::kDoubtful,
        "scan matching and the IMU contradict each other, and turns were too few to be sure; "
        "likeliest: " +
            Describe(*convention));
  }
  if (auto cause = impl_->place.Doubt()) suspected.push_back(*std::move(cause));
  return impl_->examiner.Judge(impl_->counters, std::move(suspected));
}

FoundSensors Odometry::found_sensors() const {
  const ExtrinsicFollower& extrinsic = impl_->extrinsic;
  return {impl_->stream.imu().convention(), extrinsic.corrected(),
          extrinsic.corrected() ? extrinsic.std() : std::nullopt, impl_->clocks.AtFirstScan()};
}

const Counters& Odometry::counters() const {
  return impl_->counters;
}

Ledgers Odometry::ledgers() const {
  Ledgers ledgers = impl_->stream.ledgers();
  ledgers.scans.num_waiting += std::ssize(impl_->queue.sweeps());
  return ledgers;
}

TrackingStatus Odometry::status() const {
  return impl_->mode.status();
}

}  // namespace lio
