// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/mode_driver.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "pipeline/mode_bench.hpp"

namespace lio {
namespace {

using test::kImuStep_s;
using test::kStandardGravity_mps2;
using test::kSweepSpan_s;
using test::ModeBench;
using test::Motion;
using test::StampAt;
using test::Straight;
using test::WithoutImu;

// Feeds the driver along a motion, and matches each sweep that waits.
struct DriverBench {
  explicit DriverBench(const Motion& along, const Options& options = {},
                       PlaceKnowledge place = PlaceKnowledge(false, false))
      : motion(along), bench(options), has_imu(options.pipeline.use_imu) {
    bench.place = place;
    driver = std::make_unique<ModeDriver>(bench.context(), bench.place);
  }

  // Feeds a sweep of the stream, after the samples that cover it.
  void FeedSweep() {
    const double end_s = sweep_start_s + kSweepSpan_s;
    if (has_imu) {
      for (const ImuReady& ready : bench.FeedImu(motion, imu_from_s, end_s + kImuStep_s)) {
        driver->Consume(ready);
      }
      imu_from_s = end_s + kImuStep_s;
    }
    const SweepPtr sweep = bench.AddSweep(sweep_start_s);
    bench.sweeps.pop_back();  // the driver puts it there
    driver->Consume(SweepReady{sweep});
    sweep_start_s = end_s;
  }
  MatchJob NextJob() { return driver->MakeJob(bench.sweeps[driver->next_sweep()]); }
  // Drives until a mode of this kind runs and all sweeps are matched, 4 s at most.
  bool DriveUntil(ModeKind kind) {
    for (int i = 0; i < 40 && driver->kind() != kind; ++i) {
      FeedSweep();
      while (driver->next_sweep() < bench.sweeps.size()) {
        insert = driver->FinishJob(bench.Matched(NextJob(), motion));
      }
    }
    return driver->kind() == kind;
  }

  Motion motion;
  ModeBench bench;
  bool has_imu;
  std::unique_ptr<ModeDriver> driver;
  InsertTask insert;
  double imu_from_s = -kSweepSpan_s;
  double sweep_start_s = 0.0;
};

TEST(ModeDriver, BeginsWithAnInitialization) {
  const DriverBench b(Straight(0.0));
  EXPECT_EQ(b.driver->kind(), ModeKind::kInitializing);
  EXPECT_EQ(b.driver->status(), TrackingStatus::kInit);
  EXPECT_EQ(b.driver->next_sweep(), 0U);
}

TEST(ModeDriver, SweepsOfTheStreamJoinTheQueue) {
  DriverBench b(Straight(0.0));
  b.FeedSweep();
  b.FeedSweep();
  ASSERT_EQ(b.bench.sweeps.size(), 2U);
  EXPECT_EQ(b.bench.sweeps.front()->start, StampAt(0.0));
}

// So does a log, or a new beginning, in the middle of a turn.
TEST(ModeDriver, ATurnOfWhichMostIsOverBeginsNoMap) {
  DriverBench b(Straight(0.0));
  const auto feed = [&b](double start_s, double share_before) {
    Sweep sweep = *b.bench.AddSweep(start_s);
    b.bench.sweeps.pop_back();
    sweep.share_before = share_before;
    b.driver->Consume(SweepReady{std::make_shared<Sweep>(sweep)});
  };
  feed(0.0, 0.6);
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_EQ(b.bench.counters.ledgers.scans.Of(ScanFate::kBeforeStart), 1);
  feed(0.1, 0.4);
  feed(0.2, 0.6);
  EXPECT_EQ(b.bench.sweeps.size(), 2U) << "a later one is matched with what is there";
}

TEST(ModeDriver, ARestLeadsToTracking) {
  DriverBench b(Straight(0.0));
  ASSERT_TRUE(b.DriveUntil(ModeKind::kTracking));
  EXPECT_EQ(b.driver->status(), TrackingStatus::kOk);
  EXPECT_EQ(b.bench.counters.num_restarts, 0);
}

TEST(ModeDriver, ADriveWithoutImuLeadsToLidarOnly) {
  DriverBench b(Straight(8.0), WithoutImu());
  ASSERT_TRUE(b.DriveUntil(ModeKind::kLidarOnly));
}

TEST(ModeDriver, AnImuThatFallsSilentIsToldAndEndsTracking) {
  DriverBench b(Straight(0.0));
  ASSERT_TRUE(b.DriveUntil(ModeKind::kTracking));
  (void)b.bench.Take<Notice>();
  ImuAbsent absent;
  absent.begin = StampAt(b.sweep_start_s);
  absent.stamp = StampAt(b.sweep_start_s + kSweepSpan_s);
  absent.evidence = "no samples";
  b.driver->Consume(absent);
  EXPECT_EQ(b.driver->kind(), ModeKind::kLidarOnly);
  const auto notices = b.bench.Take<Notice>();
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices.front().text.starts_with("no samples: lidar-only odometry"));
  EXPECT_EQ(notices.front().severity, Notice::Severity::kWarning);
}

TEST(ModeDriver, AnImuThatAppearsLetsTheStartBeginAnew) {
  DriverBench b(Straight(8.0), WithoutImu());
  ASSERT_TRUE(b.DriveUntil(ModeKind::kLidarOnly));
  b.FeedSweep();
  b.driver->Consume(ImuAppeared{StampAt(b.sweep_start_s)});
  EXPECT_EQ(b.driver->kind(), ModeKind::kInitializing);
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_EQ(b.bench.counters.num_restarts, 1);
}

// A segment starts before a start and after it, and counts once each.
TEST(ModeDriver, ASegmentThatStartsIsCountedAsARestart) {
  DriverBench b(Straight(0.0));
  const auto start_segment = [&] {
    b.driver->Consume(SegmentStarts{test::ExactSample(b.motion, b.sweep_start_s + 0.5),
                                    ImuPreprocessor::Step::kGap, StampAt(b.sweep_start_s)});
  };
  b.FeedSweep();
  start_segment();
  EXPECT_EQ(b.driver->kind(), ModeKind::kInitializing);
  EXPECT_EQ(b.bench.counters.num_restarts, 1);
  ASSERT_TRUE(b.DriveUntil(ModeKind::kTracking));
  start_segment();
  EXPECT_EQ(b.driver->kind(), ModeKind::kTracking);
  EXPECT_EQ(b.bench.counters.num_restarts, 2);
}

TEST(ModeDriver, ARejectionDropsAllSweeps) {
  Options options;
  options.rig.imu.units = ImuUnits::kSi;
  DriverBench b(Straight(0.0), options);
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  ASSERT_TRUE(b.DriveUntil(ModeKind::kRejected));
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_EQ(b.driver->status(), TrackingStatus::kInit);
  b.driver->Consume(StreamEnded{});
  EXPECT_EQ(b.driver->kind(), ModeKind::kRejected);
}

TEST(ModeDriver, NoticesOfTheStreamPassButReasonsToWaitOnlyOnceASecond) {
  DriverBench b(Straight(0.0));
  for (int i = 0; i < 3; ++i) {
    b.driver->Consume(Notice{StampAt(5.0), Notice::Severity::kWarning, "gap"});
    b.driver->Consume(Notice{StampAt(5.0), Notice::Severity::kInfo, "waits"});
  }
  EXPECT_EQ(b.bench.Take<Notice>().size(), 4U);
}

TEST(ModeDriver, WhileThePlaceIsSoughtNoPoseIsPublished) {
  DriverBench b(Straight(0.0), {}, PlaceKnowledge(true, true));
  ASSERT_TRUE(b.DriveUntil(ModeKind::kTracking));
  EXPECT_EQ(b.driver->status(), TrackingStatus::kInit);
  b.FeedSweep();
  EXPECT_TRUE(b.bench.Take<NavOutput>().empty());
  const MatchJob job = b.NextJob();
  EXPECT_TRUE(job.seeks_place);
  MatchOutcome outcome = b.bench.Matched(job, b.motion);
  outcome.place = FoundPlace{};
  outcome.place->cov.diagonal() << Vector3::Constant(1e-4), Vector3::Constant(1e-6);
  const InsertTask insert = b.driver->FinishJob(outcome);
  EXPECT_FALSE(insert.T_map_imu);  // the map is locked
  EXPECT_EQ(b.driver->status(), TrackingStatus::kOk);
  b.FeedSweep();
  EXPECT_FALSE(b.bench.Take<NavOutput>().empty());
  EXPECT_EQ(b.NextJob().map_action, MapAction::kEnter);
}

}  // namespace
}  // namespace lio
