// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/sensor_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "stream/lone_clock_step.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {
namespace {

// Returns the largest rate that a message can hold, in any of the units that the option allows.
double MaxRateSent(ImuUnits units) {
  ImuConvention convention = ConventionOf(units);
  convention.is_in_deg |= units == ImuUnits::kAutomatic;
  return kMaxGyroRate_radps / convention.rate_scale();
}

}  // namespace

SensorStream::SensorStream(const StreamOptions& options, Counters& counters)
    : options_(options),
      counters_(&counters),
      has_imu_(options.use_imu),
      preprocessor_(counters, MaxRateSent(options.units)),
      imu_(options.convention.value_or(ConventionOf(options.units)), counters),
      assembler_(counters),
      gate_(counters),
      corrections_(options.max_unmatched.value_or(1)) {}

void SensorStream::Notify(Timestamp stamp, Notice::Severity severity, std::string text) {
  events_.emplace_back(Notice{stamp, severity, std::move(text)});
}

void SensorStream::AddImu(const ImuSample& sample) {
  counters_->ledgers.samples.Receive();
  if (!options_.use_imu || life_ == Life::kRejected) {
    ++counters_->num_imu;
    counters_->ledgers.samples.Settle(SampleFate::kUnwanted);
    return;
  }
  if (!RefuseForeign(sample)) Enqueue({sample, std::nullopt, 0});
}

void SensorStream::AddChunk(ScanChunk chunk, std::int64_t decode_ns) {
  counters_->ledgers.chunks.Receive();
  if (life_ == Life::kRejected) {
    ++counters_->num_chunks;
    counters_->ledgers.chunks.Settle(ChunkFate::kUnwanted);
    return;
  }
  if (RefuseForeign(chunk)) return;
  chunk.stamp = chunk.stamp + Duration::FromSeconds(options_.lidar_clock_offset_s);
  Enqueue({{}, std::move(chunk), decode_ns});
}

bool SensorStream::RefuseForeign(const ImuSample& sample) {
  if (!senders_.imu.IsForeign(sample.seq, sample.stamp)) return false;
  ++counters_->num_imu;
  counters_->ledgers.samples.Settle(SampleFate::kForeign);
  if (counters_->num_imu_foreign++ == 0) {
    Notify(sample.stamp, Notice::Severity::kWarning,
           fmt::format("two senders of inertial samples on one channel: the one that came first is "
                       "kept (its number is now {}), the other refused (number {}); give each a "
                       "channel prefix of its own",
                       static_cast<std::int32_t>(senders_.imu.kept_seq()), sample.seq));
  }
  return true;
}

// Another lidar is taken once the first one has been silent for long.
bool SensorStream::RefuseForeign(const ScanChunk& chunk) {
  const bool is_kept = !senders_.lidar || senders_.lidar->sensor_id == chunk.sensor_id ||
                       Abs(chunk.stamp - senders_.lidar->newest) > kStream.replaces_lidar_after;
  if (is_kept) {
    senders_.lidar = {chunk.sensor_id, chunk.stamp};
    return false;
  }
  ++counters_->num_chunks;
  counters_->ledgers.chunks.Settle(ChunkFate::kForeign);
  if (counters_->num_chunks_foreign++ == 0) {
    Notify(chunk.stamp, Notice::Severity::kWarning,
           fmt::format("two lidars on one channel: sensor_id {} came first and is kept, sensor_id "
                       "{} is refused; give each a channel prefix of its own",
                       int{senders_.lidar->sensor_id}, int{chunk.sensor_id}));
  }
  return true;
}

void SensorStream::Inbox::Put(Message message) {
  num_points += message.num_points();
  num_chunks += message.chunk ? 1 : 0;
  messages.push_back(std::move(message));
}

SensorStream::Message SensorStream::Inbox::Take() {
  Message message = std::move(messages.front());
  messages.pop_front();
  num_points -= message.num_points();
  num_chunks -= message.chunk ? 1 : 0;
  return message;
}

// While a match is out, only so many messages wait behind a step: newer ones are dropped and
// counted.
void SensorStream::Enqueue(Message message) {
  if (inbox_.messages.size() < kStream.max_waiting_messages &&
      inbox_.num_points + message.num_points() <= kStream.max_waiting_points) {
    return inbox_.Put(std::move(message));
  }
  if (message.chunk) {
    ++counters_->num_chunks;
    ++counters_->num_chunks_late;
    counters_->ledgers.chunks.Settle(ChunkFate::kLate);
  } else {
    ++counters_->num_imu;
    ++counters_->num_imu_late;
    counters_->ledgers.samples.Settle(SampleFate::kLate);
  }
}

void SensorStream::Flush() {
  if (life_ == Life::kOpen || life_ == Life::kClosed) life_ = Life::kFlushed;
}

void SensorStream::Reject() {
  life_ = Life::kRejected;
  state_ = State::kFlowing;
  Ledgers& ledgers = counters_->ledgers;
  ledgers.samples.Settle(SampleFate::kUnwanted, std::exchange(step_, {}).result.accepted.size());
  ledgers.scans.Settle(ScanFate::kUnwanted, NumSweepsReady());
  const std::size_t num_held = lidar_clock_.Release().size();
  counters_->num_chunks += static_cast<std::int64_t>(num_held);
  ledgers.chunks.Settle(ChunkFate::kUnwanted, num_held);
  events_.clear();
  for (const Message& message : std::exchange(inbox_, {}).messages) {
    if (message.chunk) {
      ++counters_->num_chunks;
      ledgers.chunks.Settle(ChunkFate::kUnwanted);
    } else {
      ++counters_->num_imu;
      ledgers.samples.Settle(SampleFate::kUnwanted);
    }
  }
}

std::size_t SensorStream::NumSweepsReady() const {
  return static_cast<std::size_t>(std::count_if(
      events_.begin(), events_.end(),
      [](const StreamEvent& event) { return std::holds_alternative<SweepReady>(event); }));
}

Ledgers SensorStream::ledgers() const {
  Ledgers ledgers = counters_->ledgers;
  ledgers.chunks.num_waiting =
      inbox_.num_chunks + static_cast<std::int64_t>(lidar_clock_.num_held());
  ledgers.samples.num_waiting = std::ssize(inbox_.messages) - inbox_.num_chunks +
                                std::ssize(step_.result.accepted) + std::ssize(late_imu_) +
                                static_cast<std::int64_t>(preprocessor_.num_held());
  ledgers.scans.num_waiting =
      static_cast<std::int64_t>(NumSweepsReady() + assembler_.num_held() + gate_.num_held());
  return ledgers;
}

std::optional<StreamEvent> SensorStream::Next(std::size_t num_unmatched) {
  while (events_.empty()) {
    if (options_.max_unmatched) {
      corrections_.Learn(num_unmatched);
      if (corrections_.IsUnknown(num_unmatched)) return std::nullopt;
    }
    if (!Advance(num_unmatched == 0)) return std::nullopt;
  }
  StreamEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

// Does one unit of work; false when there is none.
bool SensorStream::Advance(bool is_idle) {
  if (state_ == State::kWaitingForIdle) {
    if (!is_idle) return false;
    StartSegment();
    return true;
  }
  if (state_ == State::kLosingImu) {
    if (!is_idle) return false;
    LoseImu();
    return true;
  }
  if (state_ == State::kJudgingStep) {
    if (step_.num_examined < inbox_.messages.size()) {
      JudgeBy(inbox_.messages[step_.num_examined++]);
    } else if (life_ == Life::kFlushed) {
      EndStep();
    } else {
      return false;
    }
    return true;
  }
  if (!step_.result.accepted.empty()) {
    AcceptAll(std::exchange(step_, {}).result.accepted);
    OpenGate();
    return true;
  }
  if (!inbox_.messages.empty()) {
    Process(inbox_.Take());
    return true;
  }
  if (life_ != Life::kFlushed) return false;
  CloseAll();
  return true;
}

void SensorStream::Process(Message message) {
  if (message.chunk) {
    ProcessChunk(std::move(*message.chunk), message.decode_ns);
  } else if (has_imu_) {
    ProcessImu(message.sample);
  } else {
    TakeLateImu(message.sample);
  }
}

void SensorStream::ProcessImu(const ImuSample& sample) {
  ImuSample shifted = sample;
  shifted.stamp = sample.stamp + imu_clock_shift_;
  ImuPreprocessor::Result result = preprocessor_.Add(shifted);
  if (preprocessor_.is_in_doubt()) TakeChunks(lidar_clock_.Release());
  if (result.step != ImuPreprocessor::Step::kNone) {
    TakeStep(std::move(result));
  } else {
    AcceptAll(result.accepted);
  }
  if (state_ == State::kFlowing && step_.result.accepted.empty()) OpenGate();
}

void SensorStream::ProcessChunk(ScanChunk chunk, std::int64_t decode_ns) {
  const std::optional<Timestamp> newest_imu = preprocessor_.newest();
  const bool is_order_known = has_imu_ && newest_imu && !preprocessor_.is_in_doubt();
  if (!is_order_known) {
    TakeChunks(lidar_clock_.Release({std::move(chunk), decode_ns}));
    return;
  }
  std::vector<LidarClockCorrector::Arrival> arrivals =
      lidar_clock_.Add({std::move(chunk), decode_ns}, *newest_imu);
  if (const auto step = lidar_clock_.TakeStep()) NotifyLidarClockSet(*step);
  TakeChunks(std::move(arrivals));
}

void SensorStream::TakeChunks(std::vector<LidarClockCorrector::Arrival> arrivals) {
  for (LidarClockCorrector::Arrival& arrival : arrivals) TakeChunk(std::move(arrival));
}

void SensorStream::TakeChunk(LidarClockCorrector::Arrival arrival) {
  const Timestamp stamp = arrival.chunk.stamp;
  if (!preprocessor_.is_in_doubt()) arbiter_.Note(stamp, preprocessor_.newest());
  assembler_.Add(std::move(arrival.chunk), arrival.decode_ns);
  if (!has_imu_ || !imu_.newest()) CloseSweepsBefore(stamp);
  OpenGate();
}

void SensorStream::NotifyLidarClockSet(const LidarClockCorrector::Step& step) {
  ++counters_->num_clock_jumps;
  Notify(step.stamp, Notice::Severity::kWarning,
         TextOfLoneStep("lidar", "IMU", step.by.Seconds(), step.shift));
}

void SensorStream::AcceptAll(const std::vector<ImuSample>& samples) {
  for (const ImuSample& sample : samples) Accept(sample);
}

void SensorStream::Accept(const ImuSample& sent) {
  if (imu_.IsFrozen(sent.stamp)) {
    ++counters_->num_imu_late;
    counters_->ledgers.samples.Settle(SampleFate::kLate);
    return;
  }
  std::vector<ImuReady> ready;
  const bool is_new = imu_.Add(MarkSaturated(sent), ready);
  Emit(std::move(ready));
  counters_->ledgers.samples.Settle(is_new ? SampleFate::kUsed : SampleFate::kDuplicate);
  if (!is_new) {
    ++counters_->num_imu_duplicate;
    return;
  }
  // The lidar's clock may be behind, and its driver late: what has not come yet is not lost.
  CloseSweepsBefore(*imu_.newest() - std::max(lidar_clock_.late_by(), Duration{}));
}

ImuSample SensorStream::MarkSaturated(ImuSample sent) {
  const ImuConvention& convention = imu_.convention();
  saturation_.Mark(sent, convention.rate_scale(), convention.force_scale());
  if (!sent.is_saturated()) return sent;
  if (counters_->num_imu_clipped++ == 0) {
    Notify(sent.stamp, Notice::Severity::kWarning,
           fmt::format("the {} is saturated: the motion beyond its range is estimated from scans "
                       "alone; use a sensor of a wider range",
                       sent.is_rate_saturated ? "gyro" : "accelerometer"));
  }
  return sent;
}

void SensorStream::Emit(std::vector<ImuReady> ready) {
  for (ImuReady& event : ready) events_.emplace_back(std::move(event));
}

// The samples have ended, and sweeps from then on are matched without them. Samples that come later
// begin a new series, so that the pause between is not taken for a clock that was set.
void SensorStream::LoseImu() {
  state_ = State::kFlowing;
  ++counters_->num_imu_gaps;
  ForgetLateImu();
  counters_->ledgers.samples.Settle(SampleFate::kForgotten, preprocessor_.num_held());
  preprocessor_ = ImuPreprocessor(*counters_, MaxRateSent(options_.units));
  GoLidarOnly("no inertial samples come any more");
  imu_.Clear();
  OpenGate();
}

}  // namespace lio
