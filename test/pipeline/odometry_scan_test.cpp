// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests how the estimator uses the outcome of a match, which is altered on its way here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Message;
using test::SecondsOf;
using test::StaticStartDrive;

std::int64_t CountingClock() {
  static std::int64_t now_ns = 0;
  return now_ns += 1000;
}

// The estimator over the drive that starts at rest; `change` may alter the outcome of every match
// whose sweep ends after `from_s`.
class AlteredRun {
 public:
  using Change = std::function<void(MatchOutcome&)>;
  explicit AlteredRun(double from_s, Change change, const Options& options = test::DriveRig())
      : odometry_(options, CountingClock),
        matching_(options),
        from_s_(from_s),
        change_(std::move(change)) {
    for (const Message& message : StaticStartDrive()) {
      message.is_imu ? odometry_.AddImu(message.sample) : odometry_.AddChunk(message.chunk);
      while (std::optional<MatchJob> job = odometry_.NextJob()) Finish(*job);
    }
    for (Output& output : odometry_.TakeOutputs()) {
      if (auto* scan = std::get_if<ScanOutput>(&output)) scans.push_back(std::move(*scan));
      if (auto* notice = std::get_if<Notice>(&output)) notices.push_back(std::move(*notice));
    }
  }
  // Rows of sweeps that were altered.
  std::vector<ScanOutput> Altered() const {
    std::vector<ScanOutput> rows;
    for (const ScanOutput& row : scans) {
      if (SecondsOf(row.scan.stamp) > from_s_) rows.push_back(row);
    }
    return rows;
  }
  const Counters& counters() const { return odometry_.counters(); }
  TrackingStatus status() const { return odometry_.status(); }

  std::vector<ScanOutput> scans;
  std::vector<Notice> notices;
  std::vector<MatchJob> jobs;
  int num_altered_inserted = 0;

 private:
  void Finish(const MatchJob& job) {
    jobs.push_back(job);
    MatchOutcome outcome = matching_.Run(job);
    const bool is_altered = SecondsOf(job.sweep->end) > from_s_;
    if (is_altered) change_(outcome);
    const InsertTask insert = odometry_.FinishJob(std::move(outcome));
    num_altered_inserted += is_altered && insert.T_map_imu;
    matching_.Insert(insert);
  }

  Odometry odometry_;
  RegistrationWorker matching_;
  double from_s_;
  Change change_;
};

double MapVariance(const ScanOutput& row) {
  return row.filter->nav.map_pose_cov.topLeftCorner<3, 3>().trace();
}

void Reject(MatchOutcome& outcome) {
  outcome.match.status = MatchStatus::kDiverged;
}

TEST(OdometryScan, ARowTellsWhatTheMatchFound) {
  const AlteredRun run(6.0, [](MatchOutcome& outcome) {
    outcome.num_used = 1234;
    outcome.match.num_matched = 987;
    outcome.match.iterations = 7;
    outcome.match.residual_rms_m = 0.125;
    outcome.match.eigenvalues << 1, 2, 3, 4, 5, 6;
    outcome.num_nonfinite = 3;
  });
  const std::vector<ScanOutput> rows = run.Altered();
  ASSERT_GE(rows.size(), 4u);
  for (const ScanOutput& row : rows) {
    EXPECT_EQ(row.scan.num_used, 1234);
    EXPECT_EQ(row.scan.num_matched, 987);
    EXPECT_EQ(row.scan.iterations, 7);
    EXPECT_EQ(row.scan.residual_rms_m, 0.125);
    EXPECT_EQ(row.scan.information_eigenvalues[5], 6.0);
    EXPECT_TRUE(row.scan.fused);
    EXPECT_EQ(row.filter->nis_dof, 6);
    EXPECT_EQ(row.filter->nis, row.scan.nis);
    EXPECT_EQ(row.filter->nav.scan_seq, row.scan.scan_seq);
  }
  EXPECT_EQ(run.counters().num_points_nonfinite, 3 * static_cast<std::int64_t>(rows.size()));
}

TEST(OdometryScan, TheTotalTimeIsTheSumOfTheStages) {
  const AlteredRun run(
      6.0, [](MatchOutcome& outcome) { outcome.stage_ns = {1, 10, 100, 1000, 5, 0, 0}; });
  const std::vector<ScanOutput> rows = run.Altered();
  ASSERT_FALSE(rows.empty());
  for (const ScanOutput& row : rows) {
    const StageTimes& stages = row.scan.stage_ns;
    const std::int64_t filter_ns = stages[static_cast<std::size_t>(Stage::kFilter)];
    EXPECT_GE(filter_ns, 1000) << "of the clock that counts";
    EXPECT_EQ(stages[static_cast<std::size_t>(Stage::kTotal)], 1116 + filter_ns);
  }
}

TEST(OdometryScan, OneJobIsOutAtATimeAndOthersOutcomesAreLeftOut) {
  const Options options = test::DriveRig();
  Odometry odometry(options);
  RegistrationWorker matching(options);
  std::optional<MatchJob> job;
  for (const Message& message : StaticStartDrive()) {
    message.is_imu ? odometry.AddImu(message.sample) : odometry.AddChunk(message.chunk);
    if (!job) job = odometry.NextJob();
  }
  ASSERT_TRUE(job);
  EXPECT_FALSE(odometry.NextJob()) << "one is out already";
  MatchOutcome stale = matching.Run(*job);
  stale.sweep = std::make_shared<Sweep>(*job->sweep);
  EXPECT_FALSE(odometry.FinishJob(std::move(stale)).T_map_imu);
  const std::optional<MatchJob> again = odometry.NextJob();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sweep, job->sweep) << "it is matched again";
}

TEST(OdometryScan, JobsCoverTheirSweepAndGuessWhereItWasTaken) {
  const AlteredRun run(1e9, nullptr);
  const test::Motion motion = test::RestThenDrive();
  int num_clearing = 0;
  for (const MatchJob& job : run.jobs) {
    num_clearing += job.map_action == MapAction::kClear;
    EXPECT_LE(job.T_any_imu.front().stamp, job.sweep->start);
    EXPECT_GE(job.T_any_imu.back().stamp, job.sweep->end);
    const double middle_s = SecondsOf(job.sweep->middle());
    if (middle_s < 2.0) continue;
    const Pose off = motion(middle_s).Inverse() * job.prior.T_map_imu;
    EXPECT_LT(off.translation.norm(), 0.1) << middle_s;
    EXPECT_NEAR(job.prior.since_last_fix_s, 0.1, 0.01);
    const auto& task = std::get<Relocalize>(job.task);
    EXPECT_EQ(task.search.region, SearchRegion::kTracked);
    EXPECT_FALSE(task.track.aligns_prior);
    EXPECT_GT((motion(middle_s).rotation * job.prior.up_map).z(), 0.0);
  }
  EXPECT_GE(num_clearing, 1);
  EXPECT_EQ(run.jobs.front().map_action, MapAction::kClear);
  EXPECT_EQ(run.jobs.back().map_action, MapAction::kKeep);
}

TEST(OdometryScan, RejectedMatchesLeaveThePredictionAndAreCounted) {
  const AlteredRun run(5.5, Reject);
  const std::vector<ScanOutput> rows = run.Altered();
  ASSERT_GE(rows.size(), 9u);
  double variance = 0.0;
  for (const ScanOutput& row : rows) {
    EXPECT_FALSE(row.scan.fused);
    EXPECT_EQ(row.scan.status, MatchStatus::kDiverged);
    EXPECT_EQ(row.filter->nis_dof, 0);
    EXPECT_EQ(row.filter->nav.status, TrackingStatus::kCoasting);
    const double now = MapVariance(row);
    EXPECT_GT(now, variance) << "less is known with every row";
    variance = now;
  }
  EXPECT_EQ(run.counters().num_matches_rejected, static_cast<std::int64_t>(rows.size()));
  EXPECT_NEAR(run.jobs.back().prior.since_last_fix_s, 0.1 * static_cast<double>(rows.size()), 0.05);
  EXPECT_LT(test::ErrorAgainst(test::RestThenDrive(), run.scans).end_m, 0.3);
}

// Half a second later the start begins anew.
TEST(OdometryScan, AfterTwoSecondsWithoutAMatchItIsLostAndSaysSoOnce) {
  const AlteredRun run(3.5, Reject);
  for (const ScanOutput& row : run.Altered()) {
    const double silent_s = SecondsOf(row.scan.stamp) - 3.5;
    if (silent_s < 1.9) {
      EXPECT_EQ(row.filter->nav.status, TrackingStatus::kCoasting);
    } else if (silent_s > 2.15) {
      EXPECT_EQ(row.filter->nav.status, TrackingStatus::kLost);
    }
  }
  EXPECT_EQ(run.status(), TrackingStatus::kInit);
  EXPECT_EQ(run.counters().num_restarts, 1);
  for (const char* text :
       {"lost: no scan has matched the map for 2 s; the pose drifts until one matches "
        "again, so look at what the lidar sees there",
        "lost: scans see enough but match the map nowhere, so initialization begins "
        "again at the last pose that was found; if it happens often, check the rig and the IMU"}) {
    EXPECT_EQ(std::count_if(run.notices.begin(), run.notices.end(),
                            [&](const Notice& notice) { return notice.text == text; }),
              1)
        << text;
  }
}

TEST(OdometryScan, WeakDirectionsAreToldAsDegenerate) {
  bool is_weak = true;
  const AlteredRun run(5.0, [&](MatchOutcome& outcome) {
    is_weak = SecondsOf(outcome.sweep->end) < 6.0;
    if (is_weak) outcome.match.degenerate_mask = 1u;
  });
  std::array<int, 2> num_rows{};
  for (const ScanOutput& row : run.Altered()) {
    const bool was_weak = SecondsOf(row.scan.stamp) < 6.0;
    ++num_rows[was_weak ? 1 : 0];
    EXPECT_EQ(row.filter->nav.status, was_weak ? TrackingStatus::kDegenerate : TrackingStatus::kOk);
    EXPECT_EQ(row.scan.degenerate_mask, was_weak ? 1u : 0u);
  }
  EXPECT_GE(num_rows[0], 4);
  EXPECT_GE(num_rows[1], 4);
}

// Matches five metres off, and as sure as ever: the gate holds them off as often as the options
// say, then the filter gives in.
TEST(OdometryScan, MatchesBeyondTheGateAreRefusedSoManyTimesInARow) {
  Options options = test::DriveRig();
  options.filter.max_gated_in_a_row = 4;
  const AlteredRun run(
      5.0, [](MatchOutcome& outcome) { outcome.match.T_map_imu.translation += Vector3(0, 5, 0); },
      options);
  const std::vector<ScanOutput> rows = run.Altered();
  ASSERT_GE(rows.size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(rows[i].scan.fused) << i;
    EXPECT_GT(rows[i].scan.nis, 22.4) << i;
  }
  EXPECT_TRUE(rows[4].scan.fused);
  EXPECT_GE(run.counters().num_gated, 4);
  EXPECT_GT(
      rows[4].filter->nav.T_map_imu.translation.y() - rows[3].filter->nav.T_map_imu.translation.y(),
      1.0);
}

// A map that tells nothing any more is grown from where the filter stands; a scan of a few points
// grows none.
TEST(OdometryScan, AfterTenUnmatchedScansTheMapIsGrownAnyway) {
  const AlteredRun many(4.0, Reject);
  EXPECT_GE(many.num_altered_inserted, 10);
  EXPECT_LE(many.num_altered_inserted, 15);  // 25 came
  const AlteredRun few(4.0, [](MatchOutcome& outcome) {
    Reject(outcome);
    outcome.num_used = 150;
  });
  EXPECT_EQ(few.num_altered_inserted, 0);
}

TEST(OdometryScan, AScanThatFindsAnEmptyMapStartsIt) {
  const AlteredRun run(
      6.2, [](MatchOutcome& outcome) { outcome.match.status = MatchStatus::kEmptyMap; });
  EXPECT_EQ(run.num_altered_inserted, static_cast<int>(run.Altered().size()));
  EXPECT_EQ(run.counters().num_matches_rejected, 0);
  EXPECT_EQ(run.status(), TrackingStatus::kOk);
  // A map of this very pose: its error begins at zero, and grows over half a sweep only.
  EXPECT_LT(MapVariance(run.Altered().back()), 1e-4);
}

}  // namespace
}  // namespace lio
