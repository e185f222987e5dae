// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/scan_fusion.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "lio/base/chi_square.hpp"
#include "pipeline/mode_bench.hpp"
#include "verdict/known_rig.hpp"

namespace lio {
namespace {

using test::kSweepSpan_s;
using test::ModeBench;
using test::StampAt;

constexpr int kMaxGated = FilterOptions{}.max_gated_in_a_row;

// A body at rest that is sure of its pose, and whose filter has the usual gate.
class ScanFusionTest : public testing::Test {
 protected:
  ScanFusionTest() {
    Estimate start;
    start.stamp = StampAt(0.0);
    start.cov.diagonal().setConstant(1e-6);
    HistoryOptions options;
    options.nis_limit = ChiSquareQuantile6(0.999);
    ImuSample sample{start.stamp, Vector3::Zero(), -options.g_world};
    history_ = std::make_unique<FilterHistory>(options, start, sample);
    for (int i = 1; i <= 200; ++i) {
      sample.stamp = StampAt(0.01 * i);
      (void)history_->AddImu(sample);
    }
  }

  // Samples of the body at rest, as the stream has kept them.
  void FeedImu(double from_s, double to_s) {
    (void)bench_.FeedImu(test::Straight(0.0), from_s, to_s);
  }
  // A drive before has shown that the rig is right within centimetres.
  void KnowTheRig() { test::KnowTheRig(bench_.examiner); }
  // Returns the next scan, matched so far away from the truth.
  MatchOutcome MatchedAt(double x_m) {
    auto sweep = std::make_shared<Sweep>();
    sweep->start = StampAt(begin_s_);
    sweep->end = StampAt(begin_s_ + kSweepSpan_s);
    begin_s_ += kSweepSpan_s;
    MatchOutcome outcome;
    outcome.sweep = sweep;
    outcome.match.status = MatchStatus::kConverged;
    outcome.match.T_map_imu.translation.x() = x_m;
    outcome.match.cov = 1e-6 * Matrix6::Identity();
    return outcome;
  }
  MatchOutcome BlindAt(double x_m) {
    MatchOutcome outcome = MatchedAt(x_m);
    outcome.match.degenerate_mask = 4;
    return outcome;
  }
  ScanReport Fuse(const MatchOutcome& outcome, const FusionSettings& settings = {}) {
    ScanReport report;
    FuseScan(outcome, settings, bench_.context(), *history_, health_, report);
    return report;
  }

  ModeBench bench_;
  std::unique_ptr<FilterHistory> history_;
  Health health_{true, TrackingStatus::kOk, std::nullopt, bench_.counters};
  double begin_s_ = 0.1;
};

TEST_F(ScanFusionTest, AMatchNearThePredictionIsFusedAndReported) {
  const ScanReport report = Fuse(MatchedAt(1e-3));
  EXPECT_TRUE(report.fused);
  EXPECT_GT(report.nis, 0.0);
  EXPECT_EQ(bench_.counters.num_gated, 0);
}

TEST_F(ScanFusionTest, AMatchFarOffThatSeesAllIsFusedAtLastWhereNothingIsKnownOfTheRig) {
  FeedImu(-4.0, 2.0);
  for (int i = 0; i < kMaxGated; ++i) EXPECT_FALSE(Fuse(MatchedAt(5.0)).fused) << i;
  EXPECT_TRUE(Fuse(MatchedAt(5.0)).fused);
}

TEST_F(ScanFusionTest, AMatchFarOffInAMapThatBeganAnewIsRefusedForGood) {
  FeedImu(-4.0, 2.0);
  FusionSettings settings;
  settings.is_map_unproved = true;
  for (int i = 0; i < 2 * kMaxGated + 2; ++i) {
    EXPECT_FALSE(Fuse(MatchedAt(5.0), settings).fused) << i;
  }
}

TEST_F(ScanFusionTest, AMatchFarOffThatDoesNotSeeAllIsRefusedForGood) {
  FeedImu(-4.0, 2.0);
  for (int i = 0; i < 2 * kMaxGated + 2; ++i) EXPECT_FALSE(Fuse(BlindAt(5.0)).fused) << i;
}

// The samples have missed nothing.
TEST_F(ScanFusionTest, ABlindMatchThatIsALittleOffIsRefusedForGood) {
  FeedImu(-4.0, 2.0);
  KnowTheRig();
  for (int i = 0; i < 2 * kMaxGated + 2; ++i) EXPECT_FALSE(Fuse(BlindAt(0.1)).fused) << i;
}

TEST_F(ScanFusionTest, ABlindMatchThatIsALittleOffIsFusedAtLastWhereTheSamplesHaveAHole) {
  FeedImu(-4.0, 0.3);
  FeedImu(0.45, 2.0);
  KnowTheRig();
  for (int i = 0; i < kMaxGated; ++i) EXPECT_FALSE(Fuse(BlindAt(0.1)).fused) << i;
  EXPECT_TRUE(Fuse(BlindAt(0.1)).fused);
}

// The samples have a hole in the third scan's sweep.
TEST_F(ScanFusionTest, AMatchFarOffIsFusedAtLastWhereTheSamplesHaveAHole) {
  FeedImu(-4.0, 0.3);
  FeedImu(0.45, 2.0);
  KnowTheRig();
  for (int i = 0; i < kMaxGated; ++i) EXPECT_FALSE(Fuse(MatchedAt(5.0)).fused) << i;
  EXPECT_EQ(bench_.counters.num_gated, kMaxGated);
  EXPECT_TRUE(Fuse(MatchedAt(5.0)).fused);
  EXPECT_NEAR(history_->At(StampAt(2.0)).state.T_map_imu.translation.x(), 5.0, 0.5);
}

// Since the last scan that was fused, the samples have missed a part of the motion.
TEST_F(ScanFusionTest, AMatchThatSeesAllIsFusedAtOnceWhereTheMotionSinceTheLastIsHidden) {
  FeedImu(-4.0, 0.13);
  FeedImu(0.29, 2.0);
  KnowTheRig();
  const MatchOutcome first = MatchedAt(1e-3);
  ASSERT_TRUE(Fuse(first).fused);
  (void)health_.AddScan(first.sweep->end, first.match, 2500, true);
  MatchOutcome outcome = MatchedAt(0.9);
  outcome.match.degenerate_mask = 1;
  EXPECT_FALSE(Fuse(outcome).fused);
  EXPECT_TRUE(Fuse(MatchedAt(0.9)).fused);
  EXPECT_NEAR(history_->At(StampAt(0.5)).state.T_map_imu.translation.x(), 0.9, 0.2);
}

// Samples that the prediction does not follow say nothing of it: lidar-only waits for its return.
TEST_F(ScanFusionTest, AMatchThatSeesAllIsFusedAtOnceWhereThePredictionFollowsNoSamples) {
  FeedImu(-4.0, 2.0);
  KnowTheRig();
  FusionSettings settings;
  settings.is_inertial = false;
  const MatchOutcome first = MatchedAt(1e-3);
  ASSERT_TRUE(Fuse(first, settings).fused);
  (void)health_.AddScan(first.sweep->end, first.match, 2500, true);
  EXPECT_TRUE(Fuse(MatchedAt(0.9), settings).fused);
  EXPECT_NEAR(history_->At(StampAt(0.5)).state.T_map_imu.translation.x(), 0.9, 0.2);
}

TEST_F(ScanFusionTest, AMatchThatIsRefusedTellsNothingOfTheSensorsErrors) {
  FeedImu(-4.0, 2.0);
  FusionSettings settings;
  settings.grows_map = true;
  const auto with_scores = [&](double x_m) {
    MatchOutcome outcome = MatchedAt(x_m);
    outcome.match.beam_pull.scores = {Vector6::Ones()};
    outcome.match.shift_per_score = Matrix6::Identity();
    outcome.match.new_content_share = 0.1;
    return outcome;
  };
  const MatchOutcome refused = with_scores(5.0);
  ASSERT_FALSE(Fuse(refused, settings).fused);
  EXPECT_TRUE(bench_.context().sensor_errors.CovPerReplacement(refused.match).isZero(0.0));
  ASSERT_TRUE(Fuse(with_scores(1e-3), settings).fused);
  EXPECT_FALSE(bench_.context().sensor_errors.CovPerReplacement(refused.match).isZero(0.0));
}

TEST_F(ScanFusionTest, AMatchFarOffIsRefusedForGoodWhereTheSamplesShowTheMotion) {
  FeedImu(-4.0, 2.0);
  KnowTheRig();
  for (int i = 0; i < 2 * kMaxGated + 2; ++i) EXPECT_FALSE(Fuse(MatchedAt(5.0)).fused) << i;
  EXPECT_NEAR(history_->At(StampAt(2.0)).state.T_map_imu.translation.x(), 0.0, 1e-9);
}

TEST_F(ScanFusionTest, AnErrorOfRegistrationIsFusedAtLastAlthoughTheSamplesShowTheMotion) {
  FeedImu(-4.0, 2.0);
  KnowTheRig();
  for (int i = 0; i < kMaxGated; ++i) EXPECT_FALSE(Fuse(MatchedAt(0.1)).fused) << i;
  EXPECT_TRUE(Fuse(MatchedAt(0.1)).fused);
}

TEST_F(ScanFusionTest, AScanThatASearchFoundIsFusedWhereverItIs) {
  FeedImu(-4.0, 2.0);
  MatchOutcome outcome = MatchedAt(50.0);
  outcome.is_relocalized = true;
  EXPECT_TRUE(Fuse(outcome).fused);
}

}  // namespace
}  // namespace lio
