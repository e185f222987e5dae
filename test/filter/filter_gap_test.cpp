// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter grows less sure where inertial samples are missing.
#include <gtest/gtest.h>

#include <cmath>

#include "filter/tumbling_filter.hpp"
#include "lio/filter/filter_history.hpp"

namespace lio {
namespace {

using test::AddImuUpTo;
using test::PoseAt;
using test::SampleAt;
using test::StampAt;
using test::StartedHistory;
using test::StartEstimate;

TEST(FilterGap, GapInTheSamplesWidensTheCovariance) {
  FilterHistory with_gap = StartedHistory();
  FilterHistory without = StartedHistory();
  AddImuUpTo(without, 0.6);
  EXPECT_EQ(with_gap.AddImu(SampleAt(0.6)), EventOutcome::kApplied);
  EXPECT_GT(with_gap.head().cov(kVel, kVel), 10 * without.head().cov(kVel, kVel));
  EXPECT_GT(with_gap.head().cov(kRot, kRot), 10 * without.head().cov(kRot, kRot));
}

// A scan in the middle of a gap makes two short steps of a long one: it stays a gap.
TEST(FilterGap, GapIsAGapWithAPoseInIt) {
  FilterHistory plain = StartedHistory();
  FilterHistory split = StartedHistory();
  EXPECT_EQ(plain.AddImu(SampleAt(0.04)), EventOutcome::kApplied);
  EXPECT_EQ(split.AddImu(SampleAt(0.04)), EventOutcome::kApplied);
  const PoseEvent worthless = PoseAt(0.02, Vector6::Zero(), 1e6);
  EXPECT_EQ(split.AddPose(StampAt(0.02), worthless), EventOutcome::kApplied);
  for (const int at : {kPos, kRot, kVel, kMapPose, kMapPose + 3}) {
    const double start = StartEstimate().cov(at, at);
    const double grown = split.head().cov(at, at) - start;
    // An interval's error lasts for that interval, so two halves add up to half of its variance.
    EXPECT_GT(grown, 0.45 * (plain.head().cov(at, at) - start)) << at;
  }
}

// The error of the samples that are missing is constant: steps that tell nothing of it do not make
// its integral surer.
TEST(FilterGap, GapGrowsWithTheSquareOfItsTimeWhateverStepsItIsMadeIn) {
  FilterHistory plain = StartedHistory();
  FilterHistory split = StartedHistory();
  for (const double t_s : {0.1, 0.2, 0.3}) {
    EXPECT_EQ(split.AddNoise(StampAt(t_s), {}), EventOutcome::kApplied);
  }
  for (FilterHistory* history : {&plain, &split}) {
    ImuSample sample = SampleAt(0.4);
    sample.made_up_w_std_radps = 2.f;
    EXPECT_EQ(history->AddImu(sample), EventOutcome::kApplied);
  }
  const double start = StartEstimate().cov(kRot, kRot);
  const double grown = plain.head().cov(kRot, kRot) - start;
  EXPECT_NEAR(std::sqrt(grown), 2.0 * 0.4, 0.02);
  EXPECT_NEAR(split.head().cov(kRot, kRot) - start, grown, 0.02 * grown);
}

// To look into a gap is to make a step that tells nothing.
TEST(FilterGap, TheEstimateWithinAGapIsThatOfAStepThere) {
  FilterHistory history = StartedHistory();
  EXPECT_EQ(history.AddNoise(StampAt(0.1), {}), EventOutcome::kApplied);
  ImuSample sample = SampleAt(0.4);
  sample.made_up_w_std_radps = 2.f;
  EXPECT_EQ(history.AddImu(sample), EventOutcome::kApplied);
  const ErrorMatrix looked_at = history.At(StampAt(0.25)).cov;
  EXPECT_EQ(history.AddNoise(StampAt(0.25), {}), EventOutcome::kApplied);
  EXPECT_NEAR((history.At(StampAt(0.25)).cov - looked_at).norm(), 0.0, 1e-12 * looked_at.norm());
}

// The samples of a slow unit are 50 ms apart: each pair has a gap of its own between them.
TEST(FilterGap, AMeasuredSampleEndsAGap) {
  FilterHistory history = StartedHistory();
  const double start = StartEstimate().cov(kRot, kRot);
  for (int k = 1; k <= 20; ++k) {
    EXPECT_EQ(history.AddImu(SampleAt(0.05 * k)), EventOutcome::kApplied);
  }
  const double std_radps = HistoryOptions{}.imu_outage.gap_gyro_std_radps;
  const double grown = history.head().cov(kRot, kRot) - start;
  EXPECT_NEAR(grown, 20.0 * std::pow(0.05 * std_radps, 2), 0.2 * grown);
}

}  // namespace
}  // namespace lio
