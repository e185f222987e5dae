// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/mode.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::kImuStep_s;
using test::ModeBench;
using test::StampAt;
using test::Straight;
using test::TrueStart;

constexpr std::array kKinds{ModeKind::kInitializing, ModeKind::kTracking, ModeKind::kLidarOnly,
                            ModeKind::kRejected};
constexpr std::array kTriggers{
    Trigger::kStarted,           Trigger::kNoImu,        Trigger::kRetry,
    Trigger::kSegmentStarts,     Trigger::kContradicted, Trigger::kLost,
    Trigger::kConventionDoubted, Trigger::kImuAppeared,  Trigger::kImuAbsent,
    Trigger::kImuReturned};

// A standstill with its inertial samples, so that every mode can begin.
struct Standstill {
  Standstill() { (void)bench.FeedImu(Straight(0.0), -0.1, kImuStep_s); }

  Mode Of(ModeKind kind) {
    const ModeContext context = bench.context();
    switch (kind) {
      case ModeKind::kInitializing:
        return Initializing(context, {});
      case ModeKind::kTracking:
        return Tracking(context, {}, TrueStart(Straight(0.0), 0.0), true);
      case ModeKind::kLidarOnly:
        return LidarOnly(context, {}, {});
      case ModeKind::kRejected:
        break;
    }
    return Rejected{};
  }
  Mode Next(ModeKind from, Trigger trigger) {
    Transition transition;
    transition.trigger = trigger;
    transition.start = TrueStart(Straight(0.0), 0.0);
    return BuildNext(Of(from), std::move(transition), bench.context());
  }

  ModeBench bench;
};

TEST(Mode, KindIsThatOfTheModeThatIsHeld) {
  Standstill rest;
  for (const ModeKind kind : kKinds) EXPECT_EQ(KindOf(rest.Of(kind)), kind) << NameOf(kind);
}

TEST(Mode, EveryRuleOfTheTableIsBuilt) {
  Standstill rest;
  for (const TransitionRule& rule : kTransitions) {
    EXPECT_EQ(KindOf(rest.Next(rule.from, rule.trigger)), rule.to)
        << NameOf(rule.from) << " by " << NameOf(rule.trigger);
  }
}

TEST(Mode, RestartsAreCounted) {
  for (const TransitionRule& rule : kTransitions) {
    Standstill rest;
    const std::int64_t before = rest.bench.context().counters.num_restarts;
    (void)rest.Next(rule.from, rule.trigger);
    EXPECT_EQ(rest.bench.context().counters.num_restarts - before, rule.is_restart ? 1 : 0)
        << NameOf(rule.from) << " by " << NameOf(rule.trigger);
    EXPECT_EQ(rest.bench.context().counters.num_lost, rule.trigger == Trigger::kLost ? 1 : 0)
        << NameOf(rule.from) << " by " << NameOf(rule.trigger);
  }
}

TEST(Mode, TransitionThatTheTableDoesNotNameThrows) {
  Standstill rest;
  for (const ModeKind from : kKinds) {
    for (const Trigger trigger : kTriggers) {
      if (FindRule(from, trigger)) continue;
      EXPECT_THROW((void)rest.Next(from, trigger), std::logic_error)
          << NameOf(from) << " by " << NameOf(trigger);
    }
  }
}

TEST(Mode, TrackingBeginsWithTheStartOfTheTransition) {
  Standstill rest;
  const Mode mode = rest.Next(ModeKind::kInitializing, Trigger::kStarted);
  EXPECT_EQ(std::get<Tracking>(mode).begin(), StampAt(0.0));
  EXPECT_EQ(StatusOf(mode), TrackingStatus::kOk);
}

TEST(Mode, HandoverOfTheTransitionReachesTheNextMode) {
  Standstill rest;
  Transition lost{.trigger = Trigger::kLost};
  lost.handover.origin = Handover::Origin::kLostLidar;
  const Mode lidar_only = rest.Of(ModeKind::kLidarOnly);
  Mode initializing = BuildNext(lidar_only, std::move(lost), rest.bench.context());
  const auto appeared = std::get<Initializing>(initializing).TakeImu({StampAt(0.0)});
  EXPECT_EQ(appeared.handover.origin, Handover::Origin::kLidar);
}

TEST(Mode, WaitingTimeOfEarlierTriesReachesTheNextOne) {
  Options options;
  options.start.wait_for_rest_s = 30.0;
  ModeBench bench(options);
  const Transition retry{.trigger = Trigger::kRetry, .initializing_since = StampAt(-40.0)};
  const Mode first = Initializing(bench.context(), {});
  Mode second = BuildNext(first, retry, bench.context());
  auto& mode = std::get<Initializing>(second);
  const test::Motion drive = test::WindingDrive(0.0);
  std::optional<Transition> started;
  for (int i = 0; i < 30 && !started; ++i) {
    const double start_s = 6.0 + 0.1 * i;
    (void)bench.FeedImu(drive, start_s, start_s + 0.1);
    bench.AddSweep(start_s);
    while (!started && mode.next_sweep() < bench.sweeps.size()) {
      InsertTask insert;
      const MatchJob job = mode.MakeJob(bench.sweeps[mode.next_sweep()]);
      started = mode.FinishJob(bench.Matched(job, drive), insert);
    }
  }
  ASSERT_TRUE(started);  // the wait for a rest was over before this try
  EXPECT_EQ(started->trigger, Trigger::kStarted);
}

TEST(Mode, RejectedMatchesNothing) {
  const Mode mode = Rejected{};
  EXPECT_EQ(StatusOf(mode), TrackingStatus::kInit);
  EXPECT_EQ(NextSweepOf(mode), 0U);
}

TEST(Mode, InitializingKeepsTheSweepsThatItLooksBackOn) {
  Standstill rest;
  Mode mode = rest.Of(ModeKind::kInitializing);
  EXPECT_EQ(NextSweepOf(mode), 0U);
  auto& initializing = std::get<Initializing>(mode);
  const MatchJob job = initializing.MakeJob(rest.bench.AddSweep(0.0));
  InsertTask insert;
  ASSERT_FALSE(initializing.FinishJob(ModeBench::Unmatched(job), insert));
  EXPECT_EQ(NextSweepOf(mode), 1U);
  EXPECT_EQ(rest.bench.sweeps.size(), 1U);
}

}  // namespace
}  // namespace lio
