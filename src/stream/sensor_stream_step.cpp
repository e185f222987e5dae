// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The stream judges gaps of the inertial stream and steps of its clock here.
#include <utility>

#include "lio/sensor/gap.hpp"
#include "lio/stream/sensor_stream.hpp"
#include "stream/lone_clock_step.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {

using Step = ImuPreprocessor::Step;

// The step is held back, with all that comes meanwhile, until a sweep tells whether the lidar's
// clock stepped as well.
void SensorStream::TakeStep(ImuPreprocessor::Result step) {
  const Timestamp newest = step.accepted.back().stamp;
  step_ = {std::move(step), 0, 0, newest};
  state_ = State::kJudgingStep;
  const ClockStep stamps = StampsOfStep();
  if (arbiter_.HasTimePassed(stamps)) {
    preprocessor_.ForgetHole();
    if (step_.result.step == Step::kSetRight) step_.result.step = Step::kGap;
    EndStep();
  } else if (!arbiter_.SeesLidarAt(stamps.before)) {
    EndStep();
  }
}

ClockStep SensorStream::StampsOfStep() const {
  return {step_.result.before, step_.result.accepted.front().stamp};
}

// Looks at a message that came after the step, without processing it.
void SensorStream::JudgeBy(const Message& message) {
  step_.num_points_examined += message.num_points();
  const bool has_waited_long = step_.num_examined > kStream.max_judged_messages ||
                               step_.num_points_examined > kStream.max_judged_points;
  if (message.chunk) {
    const StepVerdict verdict = arbiter_.Judge(
        StampsOfStep(), lidar_clock_.PutRight(message.chunk->stamp), step_.newest_examined);
    if (verdict.lidar == LidarClock::kStepped || has_waited_long) {
      EndStep();
    } else if (verdict.lidar == LidarClock::kSteady) {
      ShiftImuClock(verdict.after_by_lidar);
    }
    return;
  }
  const Timestamp stamp = message.sample.stamp + imu_clock_shift_;
  if (stamp > step_.newest_examined && stamp - step_.newest_examined < kImuGap.confirmed) {
    step_.newest_examined = stamp;
  }
  const Duration waited = step_.newest_examined - step_.result.accepted.back().stamp;
  if (waited > kStream.wait_for_lidar || has_waited_long) EndStep();
}

// The inertial clock has stepped alone: its stamps are corrected so that they continue where they
// were or, where samples were missing meanwhile, where the lidar says.
void SensorStream::ShiftImuClock(Timestamp after_by_lidar) {
  const Timestamp after = step_.result.accepted.front().stamp;
  const bool was_missing = after_by_lidar - step_.result.before > kImuGap.bridged;
  Duration shift = Duration::FromSeconds(-step_.result.clock_step_s);
  if (was_missing) shift = after_by_lidar - after;
  if (step_.result.undoes_hole) shift = {};
  imu_clock_shift_ = imu_clock_shift_ + shift;
  preprocessor_.ShiftBy(shift);
  for (ImuSample& sample : step_.result.accepted) sample.stamp = sample.stamp + shift;
  Notify(step_.result.accepted.front().stamp, Notice::Severity::kWarning,
         TextOfLoneStep("IMU", "lidar", step_.result.clock_step_s, imu_clock_shift_));
  state_ = State::kFlowing;
}

// A hole of less than a second needs no new segment. After anything else the stream waits until the
// sweeps before it are matched.
void SensorStream::EndStep() {
  if (step_.result.step == Step::kHole) {
    const ClockStep stamps = StampsOfStep();
    if (!arbiter_.HasTimePassed(stamps)) events_.emplace_back(AmbiguousClockStep{stamps});
    state_ = State::kFlowing;
    return;
  }
  state_ = State::kWaitingForIdle;
  const Timestamp first = step_.result.accepted.front().stamp;
  const Timestamp newest = *imu_.newest();
  assembler_.CloseSegment(newest, first);
  TakeClosedSweeps();
  while (begin_ && !gate_.empty() && (first < newest || gate_.oldest().end < first)) {
    ++counters_->num_scans_without_imu;
    Admit(gate_.Force());
  }
}

void SensorStream::StartSegment() {
  state_ = State::kFlowing;
  const ImuSample& first = step_.result.accepted.front();
  gate_.StartSegment(first.stamp);
  if (!has_imu_) {
    has_imu_ = true;
    events_.emplace_back(ImuAppeared{first.stamp});
    return;
  }
  std::optional<Timestamp> last_imu;
  if (!imu_.samples().empty()) last_imu = imu_.samples().back().stamp;
  imu_.Clear();
  events_.emplace_back(SegmentStarts{ToSi(imu_.convention(), first), step_.result.step, last_imu});
}

void SensorStream::ForgetLateImu() {
  counters_->ledgers.samples.Settle(SampleFate::kForgotten, std::exchange(late_imu_, {}).size());
}

// Takes an IMU that comes up after the lidar. A stray sample is none, and neither is one by another
// clock.
void SensorStream::TakeLateImu(const ImuSample& sample) {
  ImuSample shifted = sample;
  shifted.stamp = sample.stamp + imu_clock_shift_;
  const ImuPreprocessor::Result result = preprocessor_.Add(shifted);
  if (result.step != Step::kNone) ForgetLateImu();
  for (const ImuSample& accepted : result.accepted) {
    const bool is_apart = NotifyIfClocksApart(accepted.stamp, lidar_clock_.newest());
    if (is_apart) ForgetLateImu();
    if (is_apart || (!late_imu_.empty() && accepted.stamp <= late_imu_.back().stamp)) {
      ++counters_->num_imu_late;
      counters_->ledgers.samples.Settle(SampleFate::kLate);
      continue;
    }
    late_imu_.push_back(accepted);
  }
  if (late_imu_.empty()) return;
  const Duration span = late_imu_.back().stamp - late_imu_.front().stamp;
  if (span < kStream.imu_appears_after) return;
  step_ = {};
  step_.result.accepted = std::exchange(late_imu_, {});
  step_.result.step = Step::kGap;
  state_ = State::kWaitingForIdle;
}

}  // namespace lio
