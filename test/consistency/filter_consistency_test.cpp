// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests whether the filter's covariance agrees with its errors: a hundred runs and more are
// compared with chi-square bands (Bar-Shalom, Li, Kirubarajan 2001, section 5.4).
#include <gtest/gtest.h>

#include <cstdio>

#include "consistency/filter_ensemble.hpp"

namespace lio::test {
namespace {

constexpr double kShare = 0.9;  // share of instants that must lie in the 95 % band

EnsembleResult Judge(const char* title, const EnsembleOptions& options) {
  const EnsembleResult result = RunEnsemble(options);
  std::printf("%s\n%s", title, Table(result).c_str());
  return result;
}

bool IsInBand(const EnsembleResult& result) {
  bool inside = result.nis.share_in_band >= kShare;
  for (const BandedSeries& block : result.blocks) inside &= block.share_in_band >= kShare;
  return inside;
}

void ExpectInBand(const EnsembleResult& result) {
  for (std::size_t b = 0; b < Blocks().size(); ++b) {
    EXPECT_GE(result.blocks[b].share_in_band, kShare) << Blocks()[b].name;
  }
  EXPECT_GE(result.nis.share_in_band, kShare);
}

// White innovations have 95 % of their correlations in the band: 19 of 20 lags; the test demands
// 17.
void ExpectWhite(const EnsembleResult& result) {
  EXPECT_GE(result.whiteness.share_in_band, 0.85);
  for (const double correlation : result.whiteness.autocorrelation) {
    EXPECT_LT(std::abs(correlation), 0.02);
  }
}

void ExpectGaussian(const EnsembleResult& result) {
  for (std::size_t b = 0; b < Blocks().size(); ++b) {
    const SigmaShares& shares = result.shares[b];
    // Errors of one run are correlated over time, so the tolerance is the scatter of some hundred
    // draws.
    EXPECT_NEAR(shares[0], 0.683, 0.08) << Blocks()[b].name;
    EXPECT_NEAR(shares[1], 0.954, 0.04) << Blocks()[b].name;
    EXPECT_NEAR(shares[2], 0.997, 0.015) << Blocks()[b].name;
  }
}

TEST(FilterConsistency, WhitePoseNoiseKeepsEveryBlockInItsBand) {
  const EnsembleResult result = Judge("white pose noise", {});
  ExpectInBand(result);
  ExpectWhite(result);
  ExpectGaussian(result);
}

TEST(FilterConsistency, NoiseMisScaledByTwoFails) {
  for (const double ratio : {0.5, 2.0}) {
    EnsembleOptions options;
    options.told_registration_ratio = ratio;
    EXPECT_FALSE(IsInBand(Judge("registration noise mis-scaled", options))) << ratio;
    options = {};
    options.told_imu_ratio = ratio;
    EXPECT_FALSE(IsInBand(Judge("IMU noise mis-scaled", options))) << ratio;
  }
}

TEST(FilterConsistency, MapGrownFromTheEstimateKeepsEveryBlockInItsBand) {
  EnsembleOptions options;
  options.map = Map::kGrown;
  const EnsembleResult result = Judge("map grown from the estimate, map pose as a state", options);
  ExpectInBand(result);
  ExpectWhite(result);
}

TEST(FilterConsistency, MapThatDriftsKeepsEveryBlockInItsBand) {
  EnsembleOptions options;
  options.map = Map::kDrifts;
  const EnsembleResult result = Judge("map that drifts, map pose as a state", options);
  ExpectInBand(result);
  ExpectWhite(result);
}

TEST(FilterConsistency, PoseTakenAsWhiteAndAbsoluteLiesOutside) {
  for (const Map map : {Map::kGrown, Map::kDrifts}) {
    EnsembleOptions options;
    options.map = map;
    options.belief = Belief::kAbsolute;
    const EnsembleResult result = Judge("the same, taken as white and absolute", options);
    EXPECT_FALSE(IsInBand(result));
    for (std::size_t b = 0; b < 2; ++b) {  // position and rotation
      EXPECT_LT(result.blocks[b].share_in_band, 0.1) << Blocks()[b].name;
      EXPECT_GT(result.blocks[b].average_per_dof, 3.0) << Blocks()[b].name;
    }
  }
}

}  // namespace
}  // namespace lio::test
