// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

// A step of the inertial clock waits so long, by its stamps, for a sweep that tells whether the
// lidar's stepped as well ...
constexpr Duration kWaitForLidar{1'000'000'000};
constexpr std::size_t kMaxHeld = 3000;   // ... or for so many messages
constexpr Duration kStray{200'000'000};  // a held sample that is so far ahead tells no time
constexpr Duration kOutage{150'000'000};
constexpr double kMaxGap_s = 3.0;
constexpr double kClockSet_s = 0.1;  // what may be missing where a clock was set

}  // namespace

// It is held back, with all that comes meanwhile, until a sweep tells whether the lidar's clock
// stepped as well.
void Odometry::Impl::TakeStep(ImuPreprocessor::Result result) {
  using enum ImuPreprocessor::Step;
  new_stretch_ = std::move(result);
  is_step_judged_ = false;
  newest_held_ = new_stretch_.accepted.back().stamp;
  const ClockStep step = ClockStepNow();
  if (arrivals_.HasTimePassed(step)) {
    intake_.ForgetHole();
    if (new_stretch_.step == kSetRight) new_stretch_.step = kGap;
    EndStretch();
  } else if (!arrivals_.SeesLidarAt(step.before)) {
    EndStretch();
  }
}

ClockStep Odometry::Impl::ClockStepNow() const {
  return {new_stretch_.before, new_stretch_.accepted.front().stamp};
}

// Not by what wild stamps say, nor for ever.
void Odometry::Impl::HoldSample(const ImuSample& sample) {
  held_.push_back({sample, std::nullopt, 0});
  if (is_step_judged_) return;
  const Timestamp stamp = sample.stamp + imu_clock_shift_;
  if (stamp > newest_held_ && stamp - newest_held_ < kStray) newest_held_ = stamp;
  const Duration waited = newest_held_ - new_stretch_.accepted.back().stamp;
  if (waited > kWaitForLidar || held_.size() > kMaxHeld) EndStretch();
}

void Odometry::Impl::HoldChunk(ScanChunk chunk, std::int64_t decode_ns) {
  const Timestamp stamp = chunk.stamp;
  held_.push_back({{}, std::move(chunk), decode_ns});
  if (is_step_judged_) return;
  const StepVerdict verdict = arrivals_.Judge(ClockStepNow(), stamp, newest_held_);
  if (verdict.lidar == LidarClock::kStepped || held_.size() > kMaxHeld) {
    EndStretch();
  } else if (verdict.lidar == LidarClock::kSteady) {
    GoOnShifted(verdict.after_by_lidar);
  }
}

// The inertial unit's clock has stepped alone: its stamps are put right, so that they go on where
// they were or, where samples were missing meanwhile, where the lidar says.
void Odometry::Impl::GoOnShifted(Timestamp after_by_lidar) {
  const Timestamp after = new_stretch_.accepted.front().stamp;
  const bool was_missing = after_by_lidar - new_stretch_.before > kOutage;
  Duration shift = Duration::FromSeconds(-new_stretch_.clock_step_s);
  if (was_missing) shift = after_by_lidar - after;
  if (new_stretch_.undoes_hole) shift = {};
  imu_clock_shift_ = imu_clock_shift_ + shift;
  intake_.ShiftBy(shift);
  for (ImuSample& sample : new_stretch_.accepted) sample.stamp = sample.stamp + shift;
  char text[160];
  std::snprintf(text, sizeof text,
                "the inertial clock stepped by %.3f s, the lidar's did not: inertial stamps are "
                "shifted by %.3f s",
                SecondsBetween(after + shift, after), imu_clock_shift_.Seconds());
  Say(new_stretch_.accepted.front().stamp, Notice::Severity::kWarning, text);
  GoOn();
}

// As if there had been no step, or a hole at most.
void Odometry::Impl::GoOn() {
  const ImuPreprocessor::Result step = std::exchange(new_stretch_, {});
  GoOnWith(step.accepted);
}

// The inertial stream has jumped to new_stretch_. What the lidar saw before is matched first, all
// that comes meanwhile waits: so it does not matter how fast jobs are finished.
void Odometry::Impl::EndStretch() {
  if (new_stretch_.step == ImuPreprocessor::Step::kHole) {
    if (!arrivals_.HasTimePassed(ClockStepNow())) step_in_doubt_ = {ClockStepNow(), std::nullopt};
    GoOn();
    return;
  }
  is_step_judged_ = true;
  const Timestamp first = new_stretch_.accepted.front().stamp;
  const bool goes_back = first < sent_.back().stamp;
  assembler_.CloseStretch(sent_.back().stamp, first);
  while (std::optional<Sweep> sweep = assembler_.Take()) gate_.Add(std::move(*sweep));
  while (history_ && !gate_.empty() && (goes_back || gate_.oldest().end < first)) {
    ++counters_.num_scans_without_imu;
    Admit(gate_.Force());
  }
  if (!HasWork()) ResumeAfterStretch();
}

void Odometry::Impl::ResumeAfterStretch() {
  const ImuPreprocessor::Result stretch = std::exchange(new_stretch_, {});
  if (use_imu_) {
    BeginNewStretch(ToSi(reading_, stretch.accepted.front()), stretch.step);
  } else {
    GoInertial(stretch.accepted.front().stamp);
  }
  GoOnWith(stretch.accepted);
}

// And with what came since the step.
void Odometry::Impl::GoOnWith(const std::vector<ImuSample>& samples) {
  for (const ImuSample& sample : samples) Accept(sample);
  // Another step may be among them: then the rest is held again, and judged as it came.
  ++feed_depth_;
  for (HeldMessage& message : std::exchange(held_, {})) {
    message.chunk ? AddChunk(std::move(*message.chunk), message.decode_ns) : AddImu(message.sample);
  }
  --feed_depth_;
  if (is_flushed_ && feed_depth_ == 0) Flush();
}

// After a long gap or a step of the clock the state goes on from where it was, unsure of what
// happened in between, at the new time.
void Odometry::Impl::BeginNewStretch(const ImuSample& first, ImuPreprocessor::Step step) {
  if (!history_ && !imu_.empty() && step != ImuPreprocessor::Step::kGap) {
    SetTimesBy(first.stamp - imu_.back().stamp);
  }
  sent_.clear();
  imu_.clear();
  mean_before_hole_.reset();
  cut_.reset();
  gate_.BeginNewStretch(first.stamp);
  ready_.clear();
  ++counters_.num_restarts;
  if (!history_) {
    BeginScoutingAnew();
    scouting_since_.reset();
    Say(first.stamp, Notice::Severity::kWarning, "inertial stamps jumped: the start begins anew");
    return;
  }
  Estimate estimate = history_->head();
  const double jump_s = SecondsBetween(estimate.stamp, first.stamp);
  // Where a clock was set, messages went on.
  const bool is_gap = step == ImuPreprocessor::Step::kGap && jump_s >= 0.0 && jump_s < kMaxGap_s;
  double unknown_s = is_gap ? jump_s : std::clamp(jump_s, kClockSet_s, kMaxGap_s);
  if (step == ImuPreprocessor::Step::kSetRight) unknown_s = kClockSet_s;
  ImuSample coast;  // straight on, without turning
  coast.stamp = estimate.stamp;
  coast.w_imu_radps = estimate.state.gyro_bias;
  coast.f_imu_mps2 =
      estimate.state.accel_bias - estimate.state.T_world_imu.rotation.conjugate() * g_world_;
  ImuSample end = coast;
  end.stamp = coast.stamp + Duration::FromSeconds(unknown_s);
  HistoryOptions history = MakeHistoryOptions();
  ProcessNoise noise = history.noise;
  noise.accel_density = history.imu_outage.gap_accel_std_mps2 * std::sqrt(unknown_s);
  noise.gyro_density = history.imu_outage.gap_gyro_std_radps * std::sqrt(unknown_s);
  const NavState before = estimate.state;
  if (unknown_s > 0.0) Propagate(estimate, coast, end, noise, g_world_);
  step_in_doubt_.reset();
  if (is_gap) {
    step_in_doubt_ = {{coast.stamp, first.stamp}, before.T_map_imu};
  } else {
    estimate.state = before;
    SetTimesBy(Duration::FromSeconds(jump_s - unknown_s));
  }
  estimate.stamp = first.stamp;
  history_.emplace(history, estimate, first);
  standstill_.Forget();
  last_published_.reset();
  char text[120];
  std::snprintf(text, sizeof text, "inertial stamps jumped by %.3f s: state carried over", jump_s);
  Say(first.stamp, Notice::Severity::kWarning, text);
}

bool Odometry::Impl::IsAfterStepInDoubt(const Sweep& sweep) const {
  return step_in_doubt_ && sweep.middle() > step_in_doubt_->stamps.before;
}

// Where a sweep after the step is if no time has passed there: the motion since, from before it.
std::optional<Pose> Odometry::Impl::GuessIfClockSet(const Sweep& sweep,
                                                    const Pose& T_map_imu_predicted) {
  if (!history_ || !IsAfterStepInDoubt(sweep)) return {};
  const auto& [stamps, T_map_before] = *step_in_doubt_;
  if (last_found_ && *last_found_ > stamps.before) return {};  // seen meanwhile
  const Pose before = T_map_before ? *T_map_before : history_->At(stamps.before).state.T_map_imu;
  return before * (history_->At(stamps.after).state.T_map_imu.Inverse() * T_map_imu_predicted);
}

void Odometry::Impl::SettleStepInDoubt(const MatchOutcome& outcome) {
  if (!IsAfterStepInDoubt(*outcome.sweep)) return;
  if (outcome.is_clock_set) {
    const ClockStep& stamps = step_in_doubt_->stamps;
    ++counters_.num_clock_jumps;
    char text[120];
    std::snprintf(text, sizeof text,
                  "stamps went %.3f s forth and nothing moved meanwhile: the clock was set",
                  SecondsBetween(stamps.before, stamps.after));
    Say(outcome.sweep->end, Notice::Severity::kWarning, text);
  }
  step_in_doubt_.reset();
}

// What is remembered by the old clock is as long ago by the new one.
void Odometry::Impl::SetTimesBy(Duration by) {
  for (std::optional<Timestamp>* stamp : {&last_fused_, &last_found_}) {
    if (*stamp) **stamp = **stamp + by;
  }
  last_fix_.stamp = last_fix_.stamp + by;
  if (resumption_) resumption_->last_fix.stamp = resumption_->last_fix.stamp + by;
  if (clock_offset_) clock_offset_->Interrupt();
}

}  // namespace lio
