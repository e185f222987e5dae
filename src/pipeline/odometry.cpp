// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "lio/base/chi_square.hpp"
#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr double kHole_s = 0.15;           // between inertial samples
constexpr double kMeanBeforeHole_s = 1.1;  // both steps of a walker: over one alone he turns
constexpr Duration kBridgeEdge{1'000'000};
constexpr double kNoImuAtAll_s = 2.0;         // scans alone for this long: the log has no IMU
constexpr std::size_t kMaxLookedBackOn = 80;  // sweeps: 4 s of a fast lidar
constexpr double kImuBuffer_s = 6.0;          // raw samples kept for a start that looks back
constexpr Duration kStampSlack{20'000'000};
constexpr double kClocksApart_s = 2.0;  // more than any message is late

// Of messages whose units may be any that the option allows.
double MaxRateSent(ImuUnits units) {
  ImuConvention reading = ConventionOf(units);
  reading.is_in_deg |= units == ImuUnits::kAutomatic;
  return kMaxGyroRate_radps / reading.rate_scale();
}

std::string JoinFaults(const std::vector<OptionFault>& faults) {
  std::string text = "unusable options:";
  for (const OptionFault& fault : faults) text += " " + fault.key + ": " + fault.message + ";";
  return text;
}

}  // namespace

Odometry::Impl::Impl(const Options& options, ClockNs clock)
    : options_(options),
      clock_(clock),
      use_imu_(options.pipeline.use_imu),
      reading_(ConventionOf(options.rig.imu.units)),
      classifier_(reading_, options.rig),
      intake_(counters_, MaxRateSent(options.rig.imu.units)),
      standstill_(options.rig.imu) {
  const std::vector<OptionFault> faults = Validate(options);
  if (!faults.empty()) throw std::invalid_argument(JoinFaults(faults));
  nis_limit_ = ChiSquareQuantile6(options.filter.gate_probability);
  if (options.filter.estimate_clock_offset && use_imu_) clock_offset_.emplace(options.rig.imu);
}

void Odometry::Impl::Say(Timestamp stamp, Notice::Severity severity, std::string text) {
  outputs_.emplace_back(Notice{stamp, severity, std::move(text)});
}

HistoryOptions Odometry::Impl::MakeHistoryOptions() const {
  const ImuRig& imu = options_.rig.imu;
  HistoryOptions history;
  history.noise = {imu.gyro_noise_density, imu.accel_noise_density, imu.gyro_bias_walk_density,
                   imu.accel_bias_walk_density};
  history.g_world = g_world_;
  history.span_s = options_.filter.history_s;
  history.nis_limit = nis_limit_;
  return history;
}

std::optional<Timestamp> Odometry::Impl::NewestImu() const {
  if (sent_.empty()) return std::nullopt;
  return sent_.back().stamp;
}

void Odometry::Impl::AddImu(const ImuSample& sample) {
  if (!options_.pipeline.use_imu || is_refused_) {
    ++counters_.num_imu;
    return;
  }
  if (IsBetweenStretches()) {
    HoldSample(sample);
    return;
  }
  if (!use_imu_) {
    TakeLateImu(sample);
    return;
  }
  const std::int64_t begin = Now();
  ImuSample shifted = sample;
  shifted.stamp = sample.stamp + imu_clock_shift_;
  ImuPreprocessor::Result result = intake_.Add(shifted);
  if (result.step != ImuPreprocessor::Step::kNone) {
    TakeStep(std::move(result));
  } else {
    for (const ImuSample& accepted : result.accepted) Accept(accepted);
  }
  filter_ns_ += Now() - begin;
  OpenGate();
}

bool Odometry::Impl::HasWork() const {
  return in_flight_ || ready_.size() > (phase_ == Phase::kScouting ? scouted_.size() : 0);
}

void Odometry::Impl::Accept(const ImuSample& sent) {
  if (cut_ && sent.stamp <= *cut_) {
    ++counters_.num_imu_late;
    return;
  }
  if (sent_.empty() || sent.stamp > sent_.back().stamp) BridgeTo(sent.stamp);
  if (!Keep(Marked(sent))) {
    ++counters_.num_imu_duplicate;
    return;
  }
  const Timestamp newest = sent_.back().stamp;
  if (history_ && !imu_.empty() && imu_.back().stamp == newest) EmitImuRate();
  assembler_.CloseUpTo(newest - Duration::FromSeconds(options_.pipeline.incomplete_sweep_wait_s));
}

// With what the end of a sensor's range hides.
ImuSample Odometry::Impl::Marked(ImuSample sent) {
  clip_watch_.Mark(sent, reading_.rate_scale(), reading_.force_scale());
  if (!sent.is_rate_saturated && !sent.is_force_saturated) return sent;
  if (counters_.num_imu_clipped++ == 0) {
    Say(sent.stamp, Notice::Severity::kWarning,
        std::string(sent.is_rate_saturated ? "the gyro" : "the accelerometer") +
            " is at the end of its range: scans alone tell how much more it was");
  }
  return sent;
}

// As it came and, where it can be in the units that are believed, as it is read. False: there is
// one of its stamp already.
bool Odometry::Impl::Keep(const ImuSample& sent) {
  if (!InsertByStamp(sent_, sent)) return false;
  const Timestamp oldest = sent_.back().stamp - Duration::FromSeconds(kImuBuffer_s);
  while (sent_.front().stamp < oldest) sent_.pop_front();
  while (!imu_.empty() && imu_.front().stamp < oldest) imu_.pop_front();
  const std::optional<ImuSample> sample = Read(sent);
  if (!sample) return true;
  InsertByStamp(imu_, *sample);
  if (history_) (void)history_->AddImu(*sample);
  return true;
}

// Across a hole in the stream neither its last sample holds nor a line to the next one: a walker's
// steps would be taken for a turn and a push. What holds is the mean of the time before it.
void Odometry::Impl::BridgeTo(Timestamp stamp) {
  if (!sent_.empty() && SecondsBetween(sent_.back().stamp, stamp) > kHole_s) {
    for (const Timestamp at : {sent_.back().stamp + kBridgeEdge, stamp - kBridgeEdge}) AddHeld(at);
  }
  mean_before_hole_.reset();
}

// What the unit would send at `stamp`, of which nothing came.
void Odometry::Impl::AddHeld(Timestamp stamp) {
  if (!mean_before_hole_) {
    const Timestamp from = sent_.back().stamp - Duration::FromSeconds(kMeanBeforeHole_s);
    const ImuStatistics before =
        Summarise(std::vector<ImuSample>(FirstNotBefore(sent_, from), sent_.cend()));
    mean_before_hole_ = sent_.back();
    mean_before_hole_->w_imu_radps = before.mean_w_radps;
    mean_before_hole_->f_imu_mps2 = before.mean_f_mps2;
  }
  mean_before_hole_->stamp = stamp;
  Keep(*mean_before_hole_);
}

void Odometry::Impl::AddRawChunk(ScanChunk chunk, std::int64_t decode_ns) {
  chunk.stamp = chunk.stamp + Duration::FromSeconds(options_.rig.lidar.clock_offset_s);
  AddChunk(std::move(chunk), decode_ns);
}

void Odometry::Impl::AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
  if (is_refused_) {
    ++counters_.num_chunks;
    return;
  }
  if (IsBetweenStretches()) {
    HoldChunk(std::move(chunk), decode_ns);
    return;
  }
  const Timestamp stamp = chunk.stamp;
  newest_chunk_ = stamp;
  if (!intake_.is_in_doubt()) arrivals_.Note(stamp, intake_.newest());
  assembler_.Add(std::move(chunk), decode_ns);
  if (!use_imu_ || sent_.empty()) {
    assembler_.CloseUpTo(stamp - Duration::FromSeconds(options_.pipeline.incomplete_sweep_wait_s));
  }
  OpenGate();
}

void Odometry::Impl::Flush() {
  is_flushed_ = true;
  if (is_refused_) return;
  if (IsBetweenStretches()) {
    if (!is_step_judged_) EndStretch();
    return;
  }
  for (const ImuSample& sample : intake_.Flush()) Accept(sample);
  assembler_.CloseAll();
  OpenGate();
  gate_.Flush();
  if (use_imu_ && sent_.empty() && !gate_.empty()) {
    GoLidarOnly("the log ended without inertial samples");
  }
  OpenGate();
  if (!use_imu_ && phase_ == Phase::kScouting && !in_flight_ && IsLastScouted()) RunLidarOnly();
  while (!gate_.empty()) {
    if (gate_.oldest().start > sent_.back().stamp) ++counters_.num_scans_without_imu;
    Admit(gate_.Force());
  }
}

void Odometry::Impl::GoLidarOnly(const std::string& why) {
  use_imu_ = false;
  clock_offset_.reset();
  Say(gate_.oldest().end, Notice::Severity::kWarning, why + ": lidar-only odometry");
}

void Odometry::Impl::OpenGate() {
  while (std::optional<Sweep> sweep = assembler_.Take()) gate_.Add(std::move(*sweep));
  if (use_imu_ && sent_.empty() && gate_.waiting_span_s() > kNoImuAtAll_s) {
    GoLidarOnly("no inertial samples come");
  }
  if (!use_imu_) {
    while (SweepPtr sweep = gate_.Force()) ready_.push_back(std::move(sweep));
    return;
  }
  std::optional<Timestamp> passed = NewestImu();
  if (passed) *passed = *passed - ClockMargin();
  while (SweepPtr sweep = gate_.Open(passed)) Admit(std::move(sweep));
  if (passed && !gate_.empty()) TellIfClocksApart(*passed, gate_.oldest().start);
}

bool Odometry::Impl::TellIfClocksApart(Timestamp imu, Timestamp lidar) {
  const double ahead_s = SecondsBetween(imu, lidar);
  if (std::abs(ahead_s) < kClocksApart_s) return false;
  char text[160];
  std::snprintf(text, sizeof text,
                "scans are stamped %.1f s %s the inertial samples and cannot be used: the sensors "
                "need one clock, or rig.lidar.clock_offset_s",
                std::abs(ahead_s), ahead_s > 0.0 ? "after" : "before");
  SayWaiting(imu, text);
  return true;
}

void Odometry::Impl::Admit(SweepPtr sweep) {
  const Timestamp earliest = history_ ? history_->start_stamp() : sent_.front().stamp;
  if (sweep->start + kStampSlack < earliest) {
    ++counters_.num_scans_without_imu;
    TellIfClocksApart(earliest, sweep->start);
    return;
  }
  // From here on nothing may change what the scan was deskewed and predicted with.
  const Timestamp until = sweep->end + ClockMargin();
  const auto bracket = FirstNotBefore(sent_, until);
  if (bracket == sent_.end()) {
    AddHeld(until);
    cut_ = until;
  } else {
    cut_ = bracket->stamp;
  }
  if (history_ && ready_.empty()) history_->KeepFrom(sweep->start - ClockMargin());
  ready_.push_back(std::move(sweep));
}

void Odometry::Impl::ShedLoad() {
  auto limit = static_cast<std::size_t>(options_.pipeline.max_queued_scans);
  // The sweep in flight is the front one, but for those a start looks back on. It may match all of
  // them anew, which is no overload.
  std::size_t first = in_flight_ ? 1 : 0;
  if (phase_ == Phase::kScouting) {
    first += scouted_.size();
    limit += kMaxLookedBackOn;
  }
  while (ready_.size() > limit + first) {
    ready_.erase(ready_.begin() + static_cast<std::ptrdiff_t>(first));
    ++counters_.num_scans_dropped;
  }
}

Odometry::Odometry(const Options& options, ClockNs clock)
    : impl_(std::make_unique<Impl>(options, clock)) {}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

void Odometry::AddImu(const ImuSample& sample) {
  impl_->AddImu(sample);
}
void Odometry::AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
  impl_->AddRawChunk(std::move(chunk), decode_ns);
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
const Counters& Odometry::counters() const {
  return impl_->counters();
}
TrackingStatus Odometry::status() const {
  return impl_->status();
}

}  // namespace lio
