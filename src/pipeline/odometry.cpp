// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/odometry.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "lio/base/chi_square.hpp"
#include "pipeline/health.hpp"
#include "pipeline/mode.hpp"

namespace lio {
namespace {

// An initialization may match all the sweeps that it looks back on anew, which is no overload.
// Chosen: 4 s of a lidar of 20 Hz (InitializingParameters::max_window_s).
constexpr std::size_t kMaxLookedBackOn = 80;

const Options& Validated(const Options& options) {
  const std::vector<OptionFault> faults = Validate(options);
  if (faults.empty()) return options;
  std::string text = "unusable options:";
  for (const OptionFault& fault : faults) text += " " + fault.key + ": " + fault.message + ";";
  throw std::invalid_argument(text);
}

StreamOptions MakeStreamOptions(const Options& options) {
  StreamOptions stream;
  stream.use_imu = options.pipeline.use_imu;
  stream.units = options.rig.imu.units;
  stream.lidar_clock_offset_s = options.rig.lidar.clock_offset_s;
  // Live, sweeps that wait for matching are dropped before so many do.
  if (options.filter.estimate_clock_offset && options.pipeline.use_imu) {
    stream.max_unmatched = static_cast<std::size_t>(options.pipeline.max_queued_scans) + 3;
  }
  stream.incomplete_sweep_wait_s = options.pipeline.incomplete_sweep_wait_s;
  return stream;
}

PoseRow MakePoseRow(const FilterReport& filter) {
  const NavOutput& nav = filter.nav;
  PoseRow row;
  row.stamp = nav.stamp;
  row.is_located = nav.status == TrackingStatus::kOk || nav.status == TrackingStatus::kDegenerate;
  row.T_map_imu = nav.T_map_imu;
  row.position_cov = filter.map_as_world_cov.topLeftCorner<3, 3>();
  row.rotation_cov = nav.pose_cov.bottomRightCorner<3, 3>();
  row.R_world_imu = nav.T_world_imu.rotation;
  row.imu_noise = filter.imu_noise;
  return row;
}

}  // namespace

class Odometry::Impl {
 public:
  Impl(const Options& options, ClockNs clock, StartIn start_in)
      : options_(Validated(options)),
        clock_(clock),
        stream_(MakeStreamOptions(options), counters_),
        convention_(options_.rig, stream_.imu()),
        examiner_(options_.rig, options_.pipeline.use_imu),
        clocks_(options_),
        extrinsic_(options_),
        place_(start_in == StartIn::kInitialMap, options_.pipeline.map_locked),
        mode_(std::make_unique<Mode>(Initializing(MakeContext(), {}))) {
    outputs_.Mute(place_.is_seeking());
  }

  void AddImu(const ImuSample& sample) {
    const std::int64_t begin_ns = NowNs();
    stream_.AddImu(sample);
    examiner_.tally().AddImu(sample.stamp);
    ConsumeEvents();
    filter_ns_ += NowNs() - begin_ns;
  }

  void AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
    stream_.AddChunk(std::move(chunk), decode_ns);
    ConsumeEvents();
  }

  void Flush() {
    stream_.Flush();
    ConsumeEvents();
  }

  std::optional<MatchJob> NextJob() {
    const std::size_t next = NextSweepOf(*mode_);
    if (in_flight_ || next >= sweeps_.size()) return std::nullopt;
    const std::int64_t begin_ns = NowNs();
    MatchJob job = std::visit([&](auto& mode) { return MakeJob(mode, sweeps_[next]); }, *mode_);
    place_.Prepare(KindOf(*mode_) == ModeKind::kTracking, job);
    outputs_.Mute(place_.is_seeking());
    in_flight_ = sweeps_[next];
    job.T_imu_lidar = extrinsic_.T_imu_lidar();
    job.filter_ns = std::exchange(filter_ns_, 0) + NowNs() - begin_ns;
    return job;
  }

  InsertTask FinishJob(MatchOutcome outcome) {
    InsertTask insert;
    const SweepPtr in_flight = std::exchange(in_flight_, nullptr);
    counters_.num_points_nonfinite += outcome.num_nonfinite;
    const std::size_t next = NextSweepOf(*mode_);
    const bool is_current = in_flight && outcome.sweep == in_flight && next < sweeps_.size() &&
                            sweeps_[next] == in_flight;
    if (is_current) {
      GoOn(std::visit([&](auto& mode) { return Finish(mode, outcome, insert); }, *mode_));
      if (place_.is_seeking()) TakePlace(outcome);
      if (place_.is_map_locked()) insert.T_map_imu.reset();
      insert.points_imu = std::move(outcome.points_imu);
      insert.tags = std::move(outcome.tags);
    }
    ConsumeEvents();
    return insert;
  }

  void ShedLoad() {
    const std::size_t first = NextSweepOf(*mode_) + (in_flight_ ? 1 : 0);
    auto limit = static_cast<std::size_t>(options_.pipeline.max_queued_scans);
    num_freed_at_once_ = std::min(num_freed_at_once_, sweeps_.size());
    limit += num_freed_at_once_;
    if (KindOf(*mode_) == ModeKind::kInitializing) limit += kMaxLookedBackOn;
    while (sweeps_.size() > limit + first) {
      sweeps_.erase(sweeps_.begin() + static_cast<std::ptrdiff_t>(first));
      ++counters_.num_scans_dropped;
    }
  }

  std::vector<Output> TakeOutputs() {
    std::vector<Output> outputs = outputs_.Take();
    for (const Output& output : outputs) {
      const auto* scan = std::get_if<ScanOutput>(&output);
      if (scan != nullptr && scan->filter) examiner_.tally().AddRow(MakePoseRow(*scan->filter));
    }
    return outputs;
  }
  const Counters& counters() const { return counters_; }
  TrackingStatus status() const {
    return place_.is_seeking() ? Health::StatusWhileSeeking(place_.was_inside()) : StatusOf(*mode_);
  }
  Verdict Judge() const { return examiner_.Judge(counters_); }
  Trust trust() const { return examiner_.trust(); }

 private:
  using Next = std::optional<Transition>;

  ModeContext MakeContext() {
    return {options_,   ChiSquareQuantile6(options_.filter.gate_probability),
            clock_,     counters_,
            outputs_,   stream_,
            sweeps_,    convention_,
            clocks_,    extrinsic_,
            imu_noise_, sensor_errors_,
            examiner_,  place_};
  }
  std::int64_t NowNs() const { return clock_ == nullptr ? 0 : clock_(); }
  // The count includes the sweep in flight.
  std::size_t NumUnmatched() const {
    const std::size_t next = std::min(NextSweepOf(*mode_), sweeps_.size());
    return std::max<std::size_t>(sweeps_.size() - next, in_flight_ ? 1 : 0);
  }
  std::optional<StreamEvent> NextEvent() {
    stream_.SetStampCorrection(clocks_.correction());
    return stream_.Next(NumUnmatched());
  }

  void TakePlace(const MatchOutcome& outcome) {
    auto* tracking = std::get_if<Tracking>(mode_.get());
    if (tracking == nullptr) return;
    if (!outcome.place) {
      outputs_.NotifyWaiting(outcome.sweep->end, "the place in the initial map is being sought");
      return;
    }
    place_.SetFound();
    outputs_.Mute(false);
    tracking->EnterMap(*outcome.place, *outcome.sweep);
  }

  void ConsumeEvents() {
    std::size_t num_freed = 0;
    while (const std::optional<StreamEvent> event = NextEvent()) {
      if (std::holds_alternative<SweepReady>(*event)) ++num_freed;
      GoOn(std::visit([&](const auto& content) { return Consume(content); }, *event));
    }
    if (num_freed > 1) num_freed_at_once_ += num_freed;
  }

  // Changes the mode where that is asked for.
  void GoOn(Next transition) {
    if (transition) {
      mode_ = std::make_unique<Mode>(BuildNext(*mode_, std::move(*transition), MakeContext()));
    }
    const auto* tracking = std::get_if<Tracking>(mode_.get());
    stream_.SetBegin(tracking ? std::optional(tracking->begin()) : std::nullopt);
    if (transition && std::holds_alternative<Rejected>(*mode_)) {
      sweeps_.clear();
      stream_.Reject();
    }
  }

  Next Consume(const ImuReady& event) {
    if (auto* tracking = std::get_if<Tracking>(mode_.get())) tracking->AddImu(event);
    return std::nullopt;
  }
  Next Consume(const SweepReady& event) {
    auto* tracking = std::get_if<Tracking>(mode_.get());
    if (tracking && sweeps_.empty()) tracking->AddSweep(*event.sweep);
    sweeps_.push_back(event.sweep);
    examiner_.tally().AddSweep(event.sweep->end);
    return std::nullopt;
  }
  Next Consume(const SegmentStarts& event) {
    if (auto* tracking = std::get_if<Tracking>(mode_.get())) {
      tracking->StartSegment(event);
      return std::nullopt;
    }
    auto* initializing = std::get_if<Initializing>(mode_.get());
    return initializing ? initializing->StartSegment(event) : std::nullopt;
  }
  Next Consume(const AmbiguousClockStep& event) {
    if (auto* tracking = std::get_if<Tracking>(mode_.get())) tracking->TakeClockStep(event);
    if (auto* initializing = std::get_if<Initializing>(mode_.get())) {
      initializing->TakeClockStep(event);
    }
    return std::nullopt;
  }
  Next Consume(const ImuAbsent& event) {
    clocks_.Stop();
    outputs_.Notify(event.stamp, Notice::Severity::kWarning,
                    event.evidence + ": lidar-only odometry");
    if (const auto* tracking = std::get_if<Tracking>(mode_.get())) {
      return tracking->TakeImuAbsent(event);
    }
    if (auto* lidar_only = std::get_if<LidarOnly>(mode_.get())) lidar_only->TakeImuAbsent();
    const auto* initializing = std::get_if<Initializing>(mode_.get());
    return initializing ? initializing->TakeImuAbsent() : std::nullopt;
  }
  Next Consume(const ImuAppeared& event) {
    sweeps_.clear();
    clocks_.Restart();
    if (auto* lidar_only = std::get_if<LidarOnly>(mode_.get())) {
      return lidar_only->TakeImu(event);
    }
    auto* initializing = std::get_if<Initializing>(mode_.get());
    return initializing ? initializing->TakeImu(event) : std::nullopt;
  }
  Next Consume(const StreamEnded& /*event*/) {
    auto* initializing = std::get_if<Initializing>(mode_.get());
    return initializing ? initializing->EndStream() : std::nullopt;
  }
  Next Consume(const Notice& notice) {
    if (notice.severity == Notice::Severity::kInfo) {
      outputs_.NotifyWaiting(notice.stamp, notice.text);
    } else {
      outputs_.Add(notice);
    }
    return std::nullopt;
  }

  MatchJob MakeJob(auto& mode, const SweepPtr& sweep) { return mode.MakeJob(sweep); }
  MatchJob MakeJob(Rejected& /*mode*/, const SweepPtr& /*sweep*/) { return {}; }

  Next Finish(auto& mode, const MatchOutcome& outcome, InsertTask& insert) {
    return mode.FinishJob(outcome, insert);
  }
  Next Finish(Rejected& /*mode*/, const MatchOutcome& /*outcome*/, InsertTask& /*insert*/) {
    return std::nullopt;
  }

  Options options_;
  ClockNs clock_;
  Counters counters_;
  OutputQueue outputs_;
  SensorStream stream_;
  std::deque<SweepPtr> sweeps_;
  ImuConventionMonitor convention_;
  ImuNoiseWatch imu_noise_;
  SensorFixedErrors sensor_errors_;
  RigExaminer examiner_;
  ClockOffsetFollower clocks_;
  ExtrinsicFollower extrinsic_;
  PlaceKnowledge place_;
  std::unique_ptr<Mode> mode_;
  SweepPtr in_flight_;  // the sweep whose job is out
  // Sweeps in the queue that one message set free together, as after a gap of the inertial stream.
  std::size_t num_freed_at_once_ = 0;
  std::int64_t filter_ns_ = 0;  // CPU time of the filter since the last job
};

Odometry::Odometry(const Options& options, ClockNs clock, StartIn start_in)
    : impl_(std::make_unique<Impl>(options, clock, start_in)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

void Odometry::AddImu(const ImuSample& sample) {
  impl_->AddImu(sample);
}
void Odometry::AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
  impl_->AddChunk(std::move(chunk), decode_ns);
}
void Odometry::Flush() {
  impl_->Flush();
}
std::optional<MatchJob> Odometry::NextJob() {
  return impl_->NextJob();
}
InsertTask Odometry::FinishJob(MatchOutcome outcome) {
  return impl_->FinishJob(std::move(outcome));
}
void Odometry::ShedLoad() {
  impl_->ShedLoad();
}
std::vector<Output> Odometry::TakeOutputs() {
  return impl_->TakeOutputs();
}
Verdict Odometry::Judge() const {
  return impl_->Judge();
}
Trust Odometry::trust() const {
  return impl_->trust();
}
const Counters& Odometry::counters() const {
  return impl_->counters();
}
TrackingStatus Odometry::status() const {
  return impl_->status();
}

}  // namespace lio
