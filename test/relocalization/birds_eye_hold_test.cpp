// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_hold.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/standing_things.hpp"

namespace lio {
namespace {

// Returns posts at random places beside a road along x, seen from a point on it.
test::Points RoadsidePosts(float x_m) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> along(-60.f, 60.f);
  std::uniform_real_distribution<float> across(8.f, 30.f);
  test::Points points;
  for (int i = 0; i < 80; ++i) {
    const float x = along(random);
    test::AddPost({x, (i % 2 == 0 ? 1.f : -1.f) * across(random)}, {x_m, 0.f}, points);
  }
  return points;
}

constexpr double kBlindStd_m = 100.0;  // as matching reports it
const Matrix6 kPriorCov = Matrix6::Identity();

MatchResult MatchAt(double x_m) {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.T_map_imu.translation.x() = x_m;
  match.cov = match.observable_cov = 1e-4 * Matrix6::Identity();
  return match;
}

MatchResult BlindMatchAt(double x_m, const Vector6& shift) {
  MatchResult match = MatchAt(x_m);
  match.status = MatchStatus::kDegenerate;
  match.cov += kBlindStd_m * kBlindStd_m * shift * shift.transpose();
  match.degenerate_mask = 1u;
  match.blind_directions = {{.shift = shift, .weight = shift}};
  return match;
}

Vector6 Along(double x, double z, double pitch) {
  Vector6 shift = Vector6::Zero();
  shift[0] = x;
  shift[2] = z;
  shift[4] = pitch;
  return shift.normalized();
}

TEST(BirdsEyeHold, PutsADegenerateMatchWhereThePostsSay) {
  BirdsEyeHold hold;
  for (int i = 0; i < 3; ++i) {
    MatchResult match = MatchAt(2.0 * i);
    hold.Apply(RoadsidePosts(2.f * static_cast<float>(i)), Quaternion::Identity(), kPriorCov,
               match);
    EXPECT_EQ(match.T_map_imu.translation.x(), 2.0 * i) << "nothing was degenerate";
  }
  MatchResult match = BlindMatchAt(4.8, Along(1.0, 0.0, 0.0));  // truth: 6 m
  hold.Apply(RoadsidePosts(6.f), Quaternion::Identity(), kPriorCov, match);
  EXPECT_NEAR(match.T_map_imu.translation.x(), 6.0, 0.25);
  EXPECT_LT(std::sqrt(match.cov(0, 0)), 0.5);
}

TEST(BirdsEyeHold, WithoutEarlierViewsAMatchStaysAsItIs) {
  BirdsEyeHold hold;
  MatchResult match = BlindMatchAt(1.0, Along(1.0, 0.0, 0.0));
  hold.Apply(RoadsidePosts(0.f), Quaternion::Identity(), kPriorCov, match);
  EXPECT_EQ(match.T_map_imu.translation.x(), 1.0);
  EXPECT_EQ(match.cov, BlindMatchAt(1.0, Along(1.0, 0.0, 0.0)).cov);
}

// Things stand alike there: the prediction rules a place out that is three metres off.
TEST(BirdsEyeHold, BelievesNoPlaceThatThePredictionRulesOut) {
  BirdsEyeHold hold;
  MatchResult first = MatchAt(0.0);
  hold.Apply(RoadsidePosts(0.f), Quaternion::Identity(), kPriorCov, first);
  MatchResult match = BlindMatchAt(2.0, Along(1.0, 0.0, 0.0));
  hold.Apply(RoadsidePosts(5.f), Quaternion::Identity(), 0.1 * kPriorCov, match);
  EXPECT_EQ(match.T_map_imu.translation.x(), 2.0);
}

// Half a metre to the side would stand for five metres up a stairwell, or for a turn of a radian.
TEST(BirdsEyeHold, TellsNothingOfHeightAndTurns) {
  for (const Vector6& shift : {Along(0.1, 1.0, 0.0), Along(0.5, 0.0, 1.0)}) {
    BirdsEyeHold hold;
    MatchResult first = MatchAt(0.0);
    hold.Apply(RoadsidePosts(0.f), Quaternion::Identity(), kPriorCov, first);
    MatchResult match = BlindMatchAt(1.5, shift);  // truth: 2 m
    hold.Apply(RoadsidePosts(2.f), Quaternion::Identity(), kPriorCov, match);
    EXPECT_EQ(match.T_map_imu.translation, Vector3(1.5, 0.0, 0.0));
    EXPECT_TRUE(match.T_map_imu.rotation.isApprox(Quaternion::Identity()));
    EXPECT_EQ(match.cov, BlindMatchAt(1.5, shift).cov);
  }
}

}  // namespace
}  // namespace lio
