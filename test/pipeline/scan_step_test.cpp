// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/scan_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr double kSpeedAlongX_mps = 10.0;
constexpr double kNever = std::numeric_limits<double>::infinity();

SweepPtr SweepOf(double start_s, double end_s) {
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(start_s);
  sweep->end = StampAt(end_s);
  return sweep;
}

// Standard deviations say how little is known at the start.
struct Unknown {
  Vector3 velocity_mps = Vector3::Zero();  // in world
  double gyro_bias_radps = 0.0;
  double rotation_rad = 0.0;  // error of the map pose
};

// A body that drives along world's x, its own x axis to the left of that, over two seconds. Its IMU
// has no noise, so the covariance is exactly what the start makes of it.
FilterHistory DrivenAlongX(const Unknown& unknown, double nis_limit = kNever) {
  HistoryOptions options;
  options.nis_limit = nis_limit;
  Estimate start;
  start.stamp = StampAt(0.0);
  start.state.T_world_imu.rotation = ExpSo3(Vector3(0, 0, M_PI / 2));
  start.state.T_map_imu = start.state.T_world_imu;
  start.state.v_world_imu = kSpeedAlongX_mps * Vector3::UnitX();
  start.cov.block<3, 3>(kVel, kVel) = unknown.velocity_mps.cwiseAbs2().asDiagonal();
  start.cov.block<3, 3>(kGyroBias, kGyroBias) =
      unknown.gyro_bias_radps * unknown.gyro_bias_radps * Matrix3::Identity();
  start.cov.block<3, 3>(kMapPose + 3, kMapPose + 3) =
      unknown.rotation_rad * unknown.rotation_rad * Matrix3::Identity();
  ImuSample sample{start.stamp, Vector3::Zero(), -options.g_world};
  FilterHistory history(options, start, sample);
  for (int i = 1; i <= 200; ++i) {
    sample.stamp = StampAt(0.01 * i);
    (void)history.AddImu(sample);
  }
  return history;
}

// Returns the scan from 0.95 to 1.05 s, matched `error` away from the truth.
MatchOutcome Matched(const Vector6& error = Vector6::Zero()) {
  MatchOutcome outcome;
  outcome.sweep = SweepOf(0.95, 1.05);
  outcome.match.status = MatchStatus::kConverged;
  const Pose truth{ExpSo3(Vector3(0, 0, M_PI / 2)), Vector3(kSpeedAlongX_mps, 0, 0)};
  outcome.match.T_map_imu = truth * ExpSe3(error);
  outcome.match.cov = 1e-6 * Matrix6::Identity();
  return outcome;
}

Vector6 Along(int axis, double size) {
  return size * Vector6::Unit(axis);
}

FilterOptions UnscaledFilter() {
  FilterOptions filter;
  filter.registration_cov_scale = 1.0;
  return filter;
}

FusedMatch Fuse(const MatchOutcome& outcome, FilterHistory& history,
                const FusionSettings& settings = {},
                const FilterOptions& filter = UnscaledFilter()) {
  return FuseMatch(outcome, {.match_cov = outcome.match.cov}, settings, filter, history);
}

// The variance that the filter takes a match to have along an axis of the imu (translation, then
// rotation), from the NIS of an error there: the map begins just before, so that nothing else is
// unknown of the pose.
double VarianceOfMatch(int axis, const Unknown& unknown, const FusionSettings& settings = {},
                       const FilterOptions& filter = UnscaledFilter()) {
  constexpr double kError = 1e-4;
  FilterHistory history = DrivenAlongX(unknown);
  (void)history.AddRebase(StampAt(1.0) - Duration{1});
  const FusedMatch fused = Fuse(Matched(Along(axis, kError)), history, settings, filter);
  EXPECT_EQ(fused.outcome, EventOutcome::kApplied);
  return kError * kError / fused.nis;
}

const Track& TrackOf(const MatchJob& job) {
  return std::get<Track>(job.task);
}

TEST(MakeTrackingJob, PredictsTheMiddleOfTheSweep) {
  const FilterHistory history = DrivenAlongX({Vector3(0.2, 0.1, 0.1)});
  const SweepPtr sweep = SweepOf(0.9, 1.1);
  const MatchJob job = MakeTrackingJob(sweep, history, std::nullopt);
  EXPECT_EQ(job.sweep, sweep);
  EXPECT_LT((job.prior.T_map_imu.translation - Vector3(10.0, 0, 0)).norm(), 1e-9);
  // A second at an unknown 0.2 m/s along world's x, which is minus y in imu.
  EXPECT_NEAR(job.prior.cov(1, 1), 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(job.prior.cov(0, 0), 0.1 * 0.1, 1e-9);
}

TEST(MakeTrackingJob, HasTheTrajectoryOverTheWholeSweep) {
  const MatchJob job = MakeTrackingJob(SweepOf(0.905, 1.105), DrivenAlongX({}), std::nullopt);
  ASSERT_GE(job.T_any_imu.size(), 20U);
  EXPECT_EQ(job.T_any_imu.front().stamp, StampAt(0.905));
  EXPECT_EQ(job.T_any_imu.back().stamp, StampAt(1.105));
  EXPECT_NEAR(job.T_any_imu.back().pose.translation.x(), 11.05, 1e-6);
}

TEST(MakeTrackingJob, AsksForNothingBesidesTracking) {
  const MatchJob job = MakeTrackingJob(SweepOf(0.9, 1.1), DrivenAlongX({}), std::nullopt);
  EXPECT_FALSE(TrackOf(job).aligns_prior);
  EXPECT_FALSE(TrackOf(job).holds_degenerate);
  EXPECT_FALSE(job.refines_deskew);
  EXPECT_EQ(job.map_action, MapAction::kKeep);
}

TEST(MakeTrackingJob, RefinesTheDeskewWhereTheTurnIsUnsure) {
  for (const double std_rad : {0.004, 0.006}) {
    Unknown unknown;
    unknown.rotation_rad = std_rad;
    const MatchJob job = MakeTrackingJob(SweepOf(0.9, 1.1), DrivenAlongX(unknown), std::nullopt);
    EXPECT_EQ(job.refines_deskew, std_rad > 0.005) << std_rad;
  }
}

TEST(MakeTrackingJob, TheShiftIsAsUnsureAsTheWorstVelocityOverTheTimeSinceTheLastFix) {
  const FilterHistory history = DrivenAlongX({Vector3(0.1, 0.3, 0.2)});
  const MatchJob job = MakeTrackingJob(SweepOf(0.9, 1.1), history, StampAt(0.5));
  EXPECT_NEAR(job.prior.since_last_fix_s, 0.5, 1e-9);
  EXPECT_NEAR(job.prior.shift_std_m, 0.15, 1e-9);
}

TEST(MakeTrackingJob, AlignsAPriorOfUnsureShift) {
  const FilterHistory history = DrivenAlongX({Vector3(1.0, 0.1, 0.1)});
  EXPECT_FALSE(TrackOf(MakeTrackingJob(SweepOf(0.9, 1.1), history, StampAt(0.31))).aligns_prior);
  EXPECT_TRUE(TrackOf(MakeTrackingJob(SweepOf(0.9, 1.1), history, StampAt(0.29))).aligns_prior);
}

TEST(MakeTrackingJob, TheTimeSinceTheLastFixIsPositive) {
  const MatchJob job = MakeTrackingJob(SweepOf(0.9, 1.1), DrivenAlongX({}), StampAt(1.5));
  EXPECT_EQ(job.prior.since_last_fix_s, 0.01);
}

TEST(FuseMatch, MovesTheEstimateToTheMatchAtTheMiddleOfTheSweep) {
  FilterHistory history = DrivenAlongX({Vector3(1.0, 1.0, 1.0)});
  EXPECT_EQ(Fuse(Matched(Along(1, -0.5)), history).outcome, EventOutcome::kApplied);
  const Estimate middle = history.At(StampAt(1.0));
  EXPECT_NEAR(middle.state.T_map_imu.translation.x(), 10.5, 0.01);
  EXPECT_NEAR(middle.state.v_world_imu.x(), 10.5, 0.01) << "for a second it was faster";
}

TEST(FuseMatch, TheCovarianceIsThatOfTheMatchTimesTheConfiguredScale) {
  FilterOptions filter;
  for (const double scale : {1.0, 1.6, 4.0}) {
    filter.registration_cov_scale = scale;
    EXPECT_NEAR(VarianceOfMatch(0, {}, {}, filter), scale * 1e-6, 1e-9) << scale;
    EXPECT_NEAR(VarianceOfMatch(5, {}, {}, filter), scale * 1e-6, 1e-9) << scale;
  }
}

TEST(FuseMatch, ErrorsThatAreAlikeFromScanToScanScaleTheWholeCovariance) {
  FusionSettings settings;
  settings.gyro_density = 0.02;
  const double alone = VarianceOfMatch(5, {}, settings);
  settings.alike_factor = 4.0;
  EXPECT_NEAR(VarianceOfMatch(5, {}, settings), 4.0 * alone, 1e-3 * alone);
}

// An error dv of the velocity shifts points by dv t about the middle: dv^2 T^2 / 12. World's x is
// minus y in imu. The tolerance is the second order of the residual.
TEST(FuseMatch, AnUnsureVelocityLeavesErrorsInTheDeskewedScan) {
  const Unknown unknown{Vector3(0.2, 0.0, 0.0)};
  const double by_deskew = 0.2 * 0.2 * 0.1 * 0.1 / 12.0;
  EXPECT_NEAR(VarianceOfMatch(1, unknown), 1e-6 + by_deskew, 1e-3 * by_deskew);
  EXPECT_NEAR(VarianceOfMatch(0, unknown), 1e-6, 1e-9);
}

// White noise is integrated to both sides of the middle: density^2 T / 12.
TEST(FuseMatch, GyroNoiseLeavesErrorsInTheDeskewedScan) {
  FusionSettings settings;
  settings.gyro_density = 0.02;
  const double by_deskew = 0.02 * 0.02 * 0.1 / 12.0;
  EXPECT_NEAR(VarianceOfMatch(5, {}, settings), 1e-6 + by_deskew, 1e-3 * by_deskew);
  EXPECT_NEAR(VarianceOfMatch(0, {}, settings), 1e-6, 1e-9);
}

// The variance is bias^2 T^2 / 12.
TEST(FuseMatch, AnUnsureGyroBiasLeavesErrorsInTheDeskewedScan) {
  Unknown unknown;
  unknown.gyro_bias_radps = 0.05;
  const double by_deskew = 0.05 * 0.05 * 0.1 * 0.1 / 12.0;
  EXPECT_NEAR(VarianceOfMatch(3, unknown), 1e-6 + by_deskew, 1e-3 * by_deskew);
}

TEST(FuseMatch, AMatchBeyondTheGateLeavesTheEstimate) {
  FilterHistory history = DrivenAlongX({Vector3(0.01, 0.01, 0.01)}, 22.5);
  const FusedMatch fused = Fuse(Matched(Along(1, -1.0)), history);
  EXPECT_EQ(fused.outcome, EventOutcome::kGated);
  EXPECT_GT(fused.nis, 22.5);
  EXPECT_NEAR(history.At(StampAt(1.0)).state.T_map_imu.translation.x(), 10.0, 1e-9);
}

TEST(FuseMatch, AForcedMatchIsFusedEvenBeyondTheGate) {
  FilterHistory history = DrivenAlongX({Vector3(0.01, 0.01, 0.01)}, 22.5);
  const MatchOutcome outcome = Matched(Along(1, -1.0));
  const MatchJudgement judgement{.match_cov = outcome.match.cov, .force = true};
  const FusedMatch fused = FuseMatch(outcome, judgement, {}, UnscaledFilter(), history);
  EXPECT_EQ(fused.outcome, EventOutcome::kApplied);
  EXPECT_GT(fused.nis, 22.5) << "as it was before it was forced";
  EXPECT_GT(history.At(StampAt(1.0)).state.T_map_imu.translation.x(), 10.4);
}

TEST(FuseMatch, AScanBeforeTheStartIsNotFused) {
  FilterHistory history = DrivenAlongX({});
  MatchOutcome outcome = Matched();
  outcome.sweep = SweepOf(-0.3, -0.2);
  const FusedMatch fused = Fuse(outcome, history);
  EXPECT_EQ(fused.outcome, EventOutcome::kBeforeStart);
  EXPECT_EQ(fused.nis, 0.0);
}

// All of the map there is of this scan: its pose is known but for what the scan brings in.
TEST(FuseMatch, AScanThatGrowsTheMapBringsItsOwnErrorIn) {
  FilterOptions filter = UnscaledFilter();
  filter.map_walk_scale = 0.5;
  for (const bool grows_map : {false, true}) {
    FilterHistory history = DrivenAlongX({Vector3(1.0, 1.0, 1.0)});
    MatchOutcome outcome = Matched();
    outcome.match.new_content_share = 1.0;
    outcome.match.observable_cov = 9e-4 * Matrix6::Identity();
    FusionSettings settings;
    settings.grows_map = grows_map;
    (void)Fuse(outcome, history, settings, filter);
    const double variance = history.At(StampAt(1.0)).cov(kMapPose, kMapPose);
    EXPECT_EQ(std::abs(variance - 0.5 * 9e-4) < 1e-9, grows_map) << variance;
  }
}

// Samples tell the motion since the last scan, which a match against what it brought does not.
TEST(FuseMatch, WhatTheLastScanBroughtTellsAnInertialFilterNothing) {
  for (const bool is_inertial : {false, true}) {
    FilterHistory history = DrivenAlongX({});
    (void)history.AddRebase(StampAt(1.0) - Duration{1});
    MatchOutcome outcome = Matched(Along(1, 1e-4));
    const double nis = 1e-8 / outcome.match.cov(1, 1);
    outcome.match.observability.share_of_last_scan = 0.75 * Matrix6::Identity();
    FusionSettings settings;
    settings.is_inertial = is_inertial;
    EXPECT_NEAR(Fuse(outcome, history, settings).nis, is_inertial ? 0.25 * nis : nis, 0.02 * nis);
  }
}

TEST(FuseMatch, AGrowingMapIsBentByTheErrorsThatMoveWithTheSensor) {
  for (const bool grows_map : {false, true}) {
    FilterHistory history = DrivenAlongX({Vector3(1.0, 1.0, 1.0)});
    MatchOutcome outcome = Matched();
    outcome.match.new_content_share = 1.0;
    FusionSettings settings;
    settings.grows_map = grows_map;
    const MatchJudgement judgement{.match_cov = outcome.match.cov,
                                   .sensor_error_cov = 1e-6 * Matrix6::Identity()};
    (void)FuseMatch(outcome, judgement, settings, UnscaledFilter(), history);
    const double variance = history.At(StampAt(1.0)).cov(kMapPose, kMapPose);
    EXPECT_EQ(std::abs(variance - 1e-6) < 1e-9, grows_map) << variance;
  }
}

// The body has not moved as far as the stamps say, and is no slower.
TEST(FuseMatch, WhereTheClockWasSetThePlaceIsCorrectedAndTheSpeedIsNot) {
  for (const bool is_clock_set : {false, true}) {
    FilterHistory history = DrivenAlongX({Vector3(0.1, 0.1, 0.1)});
    MatchOutcome outcome = Matched(Along(1, 5.0));
    outcome.is_clock_set = is_clock_set;
    (void)Fuse(outcome, history);
    const NavState state = history.At(StampAt(1.0)).state;
    EXPECT_NEAR(state.T_map_imu.translation.x(), 5.0, 0.1);
    EXPECT_NEAR(state.v_world_imu.x(), is_clock_set ? kSpeedAlongX_mps : 5.0, 0.2);
  }
}

TEST(MakeScanReport, SaysWhatMatchingDid) {
  MatchOutcome outcome;
  auto sweep = std::make_shared<Sweep>(*SweepOf(0.9, 1.1));
  sweep->scan_seq = 42;
  sweep->points.resize(7);
  outcome.sweep = sweep;
  outcome.num_used = 6;
  outcome.match.num_matched = 5;
  outcome.match.iterations = 4;
  outcome.match.status = MatchStatus::kDegenerate;
  outcome.match.residual_rms_m = 0.03;
  outcome.match.eigenvalues << 1, 2, 3, 4, 5, 6;
  outcome.match.degenerate_mask = 0b101;
  const ScanReport report = MakeScanReport(outcome);
  EXPECT_EQ(report.stamp, StampAt(1.1));
  EXPECT_EQ(report.scan_seq, 42);
  EXPECT_EQ(report.num_raw, 7);
  EXPECT_EQ(report.num_used, 6);
  EXPECT_EQ(report.num_matched, 5);
  EXPECT_EQ(report.iterations, 4);
  EXPECT_EQ(report.status, MatchStatus::kDegenerate);
  EXPECT_EQ(report.residual_rms_m, 0.03);
  EXPECT_EQ(report.information_eigenvalues, outcome.match.eigenvalues);
  EXPECT_EQ(report.degenerate_mask, 0b101U);
  EXPECT_FALSE(report.fused) << "that is the filter's part";
}

TEST(CompleteTimes, AddsTheFiltersTimeAndTheTotal) {
  StageTimes stage_ns{1, 20, 300, 4000, 50000, 600000, 0};
  ScanReport report;
  CompleteTimes(stage_ns, 7000000, report);
  EXPECT_EQ(report.stage_ns, (StageTimes{1, 20, 300, 4000, 50000, 7600000, 7654321}));
}

}  // namespace
}  // namespace lio
