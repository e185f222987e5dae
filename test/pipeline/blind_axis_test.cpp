// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/blind_axis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "support/random_state.hpp"

namespace lio {
namespace {

constexpr double kBlindStd_m = 100.0;
constexpr double kPoseStd = 1e-3;       // m, rad, across the axis
constexpr double kRatio = 7.0;          // the information over that of noise, along the axis
constexpr double kDirectionStd = 1e-3;  // m, rad per metre along the axis
const Matrix6 kSure = Matrix6::Zero();  // the prior's covariance

// Returns a match at a pose that sees all but a metre along `shift`, where rotations count as
// metres.
MatchResult BlindAlong(const Vector6& shift, const Pose& T_map_imu) {
  MatchResult match;
  match.status = MatchStatus::kDegenerate;
  match.T_map_imu = T_map_imu;
  const Vector6 unit = shift.normalized();
  const Matrix6 across = Matrix6::Identity() - unit * unit.transpose();
  match.observable_cov = kPoseStd * kPoseStd * across;
  match.cov = match.observable_cov + kBlindStd_m * kBlindStd_m * unit * unit.transpose();
  match.blind_directions = {{unit, unit, kDirectionStd * kDirectionStd * across}};
  match.degenerate_mask = 1;
  match.observability.counted = kRatio * Matrix6::Identity();
  match.observability.noise = Matrix6::Identity();
  return match;
}

// Returns a match that sees all directions, with so many times the ratio of blind ones.
MatchResult SeeingAll(double factor) {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.observable_cov = kPoseStd * kPoseStd * Matrix6::Identity();
  match.cov = match.observable_cov;
  match.observability.counted = factor * kRatio * Matrix6::Identity();
  match.observability.noise = Matrix6::Identity();
  return match;
}

Vector6 WithNoise(const Vector6& shift, std::mt19937_64& random) {
  return shift + kDirectionStd * test::RandomVector<6>(random);
}

// Returns the body at `along` metres of a straight tunnel along map's x axis; it pitches as it
// drives.
Pose InTunnel(double along_m) {
  return {ExpSo3(Vector3(0, 0.01 * std::sin(0.2 * along_m), 0)), Vector3(along_m, 0, 0)};
}

Vector6 TunnelAxisAt(const Pose& T_map_imu) {
  Vector6 shift = Vector6::Zero();
  shift.head<3>() = T_map_imu.rotation.conjugate() * Vector3::UnitX();
  return shift;
}

// Returns how well so many matches together claim to know the place along the tunnel.
template <class CovOf>
double StdAlongTunnel(int num_matches, const CovOf& cov_of) {
  std::mt19937_64 random(1);
  Matrix6 information = Matrix6::Zero();
  for (int i = 0; i < num_matches; ++i) {
    const Pose pose = InTunnel(0.5 * i);
    const MatchResult match = BlindAlong(WithNoise(TunnelAxisAt(pose), random), pose);
    Matrix6 to_map = Matrix6::Zero();  // translations and rotations are along map's axes
    to_map.topLeftCorner<3, 3>() = to_map.bottomRightCorner<3, 3>() =
        pose.rotation.toRotationMatrix();
    information += to_map * cov_of(match).inverse() * to_map.transpose();
  }
  return std::sqrt(information.inverse()(0, 0));
}

TEST(BlindAxis, NoisyDirectionsOfATunnelDoNotTellThePlaceAlongIt) {
  BlindAxis axis;
  const double own_m = StdAlongTunnel(400, [](const MatchResult& match) { return match.cov; });
  const double mean_m =
      StdAlongTunnel(400, [&](const MatchResult& match) { return axis.Judge(match, kSure).cov; });
  EXPECT_LT(own_m, 0.05);
  EXPECT_GT(mean_m, 4.0 * own_m);
}

// Returns the direction along which a covariance is blind.
Vector6 BlindDirectionOf(const Matrix6& cov) {
  return cov.col(0).normalized();
}

TEST(BlindAxis, TheMeanIsNearerToTheTruthThanItsMatchesAlongACircleToo) {
  std::mt19937_64 random(2);
  constexpr double kRadius_m = 50.0;
  Vector6 truth = Vector6::Zero();  // the same at all places of the circle
  truth[0] = 1.0;
  truth[5] = 1.0 / kRadius_m;
  truth.normalize();
  BlindAxis axis;
  double of_matches = 0.0;
  double of_mean = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double angle_rad = 0.5 * i / kRadius_m;
    const Pose pose{ExpSo3(Vector3(0, 0, angle_rad)),
                    kRadius_m * Vector3(std::sin(angle_rad), 1.0 - std::cos(angle_rad), 0.0)};
    const MatchResult match = BlindAlong(WithNoise(truth, random), pose);
    const Vector6 mean = BlindDirectionOf(axis.Judge(match, kSure).cov);
    if (i < 50) continue;
    of_matches += (match.blind_directions.front().shift - truth).squaredNorm();
    of_mean += (mean - truth).squaredNorm();
  }
  EXPECT_LT(of_mean, 0.1 * of_matches);
}

TEST(BlindAxis, AnotherTunnelBeginsAnew) {
  BlindAxis axis;
  std::mt19937_64 random(3);
  const Pose at_rest;
  Vector6 other = TunnelAxisAt(at_rest);
  other[1] = 0.1;
  for (int i = 0; i < 30; ++i) {
    (void)axis.Judge(BlindAlong(WithNoise(TunnelAxisAt(at_rest), random), at_rest), kSure);
  }
  const MatchResult match = BlindAlong(other, at_rest);
  EXPECT_LT((axis.Judge(match, kSure).cov - match.cov).norm(), 1e-9 * match.cov.norm());
}

MatchResult BlindAlongXAndY() {
  MatchResult match = BlindAlong(Vector6::UnitX(), {});
  match.blind_directions.push_back(BlindAlong(Vector6::UnitY(), {}).blind_directions.front());
  return match;
}

TEST(BlindAxis, MatchesThatSeeAllOrTwoDirectionsLessStayAsTheyAreWhereThePriorIsSure) {
  BlindAxis axis;
  MatchResult match = BlindAlongXAndY();
  EXPECT_EQ(axis.Judge(match, kSure).cov, match.cov);
  match.blind_directions.clear();
  EXPECT_EQ(axis.Judge(match, Matrix6::Identity()).cov, match.cov);
}

// A direction that is turned by its standard deviation shows a prior's standard deviation of 2 m
// along it as this times 2 m across.
TEST(BlindAxis, ErrorsOfTwoBlindDirectionsGrowWithThePrior) {
  BlindAxis axis;
  const MatchResult match = BlindAlongXAndY();
  Matrix6 prior_cov = Matrix6::Zero();
  prior_cov(0, 0) = 4.0;
  const Matrix6 added = axis.Judge(match, prior_cov).cov - match.cov;
  const Matrix6& of_x = match.blind_directions.front().cov;
  ASSERT_GT(of_x(2, 2), 0.0);
  EXPECT_LT((added - 4.0 * of_x).norm(), 1e-9 * added.norm());
}

BlindAxis AfterBlindMatches(int num) {
  BlindAxis axis;
  for (int i = 0; i < num; ++i) (void)axis.Judge(BlindAlong(Vector6::UnitX(), {}), kSure);
  return axis;
}

// The cells around have the error, and many scans see the same cells.
TEST(BlindAxis, ManyBlindMatchesInARowTellNoMoreOfTheDirectionThanOne) {
  const MatchResult match = BlindAlong(Vector6::UnitX(), {});
  Matrix6 prior_cov = Matrix6::Zero();
  prior_cov(0, 0) = 4.0;
  const double one = 4.0 * kDirectionStd * kDirectionStd;  // m^2, across
  for (const int num : {1, 10, 100}) {
    BlindAxis axis = AfterBlindMatches(num - 1);
    const double across = axis.Judge(match, prior_cov).cov(2, 2) - kPoseStd * kPoseStd;
    EXPECT_NEAR(across, num * one, 1e-3 * num * one);
  }
}

TEST(BlindAxis, AMatchThatSeesAllEndsTheRow) {
  BlindAxis axis = AfterBlindMatches(50);
  (void)axis.Judge(SeeingAll(3.0), kSure);
  Matrix6 prior_cov = Matrix6::Zero();
  prior_cov(0, 0) = 4.0;
  const Matrix6 cov = axis.Judge(BlindAlong(Vector6::UnitX(), {}), prior_cov).cov;
  EXPECT_LT(cov(2, 2), 2.0 * kPoseStd * kPoseStd + 5.0 * kDirectionStd * kDirectionStd);
}

TEST(BlindAxis, AMatchThatTellsNoMoreThanBlindOnesIsBlind) {
  BlindAxis axis = AfterBlindMatches(10);
  const BlindAxis::Answer answer = axis.Judge(SeeingAll(1.2), kSure);
  EXPECT_TRUE(answer.is_blind);
  EXPECT_GT(answer.cov(0, 0), 0.9 * kBlindStd_m * kBlindStd_m);
  EXPECT_NEAR(answer.cov(1, 1), kPoseStd * kPoseStd, 1e-9);
}

TEST(BlindAxis, AMatchThatTellsClearlyMoreIsBelieved) {
  BlindAxis axis = AfterBlindMatches(10);
  const BlindAxis::Answer answer = axis.Judge(SeeingAll(3.0), kSure);
  EXPECT_FALSE(answer.is_blind);
  EXPECT_EQ(answer.cov, SeeingAll(3.0).cov);
}

TEST(BlindAxis, OneBlindMatchAmongManyChangesNoOther) {
  BlindAxis axis;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(axis.Judge(SeeingAll(1.2), kSure).is_blind);
  EXPECT_TRUE(axis.Judge(BlindAlong(Vector6::UnitX(), {}), kSure).is_blind);
  EXPECT_FALSE(axis.Judge(SeeingAll(1.2), kSure).is_blind);
}

TEST(BlindAxis, MatchesThatGoOnSeeingAreBelieved) {
  BlindAxis axis = AfterBlindMatches(100);
  int num_blind = 0;
  for (int i = 0; i < 20; ++i) num_blind += axis.Judge(SeeingAll(1.2), kSure).is_blind ? 1 : 0;
  EXPECT_LT(num_blind, 8);
}

TEST(BlindAxis, ResetForgetsTheAxis) {
  BlindAxis axis = AfterBlindMatches(100);
  axis.Reset();
  EXPECT_FALSE(axis.Judge(SeeingAll(1.2), kSure).is_blind);
}

TEST(BlindAxis, AMethodThatDoesNotTellHowWellItKnowsTheDirectionIsBelieved) {
  BlindAxis axis;
  (void)axis.Judge(BlindAlong(Vector6::UnitX(), {}), kSure);
  std::mt19937_64 random(4);
  MatchResult match = BlindAlong(WithNoise(Vector6::UnitX(), random), {});
  match.blind_directions.front().cov.setZero();
  EXPECT_EQ(axis.Judge(match, kSure).cov, match.cov);
}

TEST(BlindAxis, ADirectionThatIsHeldOtherwiseStaysHeld) {
  BlindAxis axis;
  MatchResult match = BlindAlong(Vector6::UnitX(), {});
  match.cov(0, 0) = 0.01;
  EXPECT_EQ(axis.Judge(match, kSure).cov, match.cov);
}

}  // namespace
}  // namespace lio
