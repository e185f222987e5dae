// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The covariance of a match, the directions that it does not see, and guesses that it contradicts.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "lio/registration/ndt_matcher.hpp"
#include "registration/ndt_matcher_in.hpp"

namespace lio {
namespace {

using test::ErrorOf;
using test::NdtMatcherIn;
using test::OnRoad;

// Returns the NEES per degree of freedom over places along a street.
double StreetNees(double shift_std_m) {
  constexpr int kRuns = 40;
  NdtMatcherIn street(test::Street());
  street.shift_std_m = shift_std_m;
  street.InsertRoad(0.0, 25.0);
  double nees = 0;
  for (int i = 0; i < kRuns; ++i) {
    const Pose truth = OnRoad(2.0 + 0.5 * i);
    const MatchResult result = street.MatchFrom(truth, Vector6::Zero(), 0.02);
    EXPECT_TRUE(result.IsUsable());
    const Vector6 error = ErrorOf(result, truth);
    nees += error.dot(result.cov.ldlt().solve(error)) / (6.0 * kRuns);
  }
  return nees;
}

// The map is one draw that all runs share, so this is no chi-square: it is right to a factor of
// two.
TEST(NdtMatcher, CovarianceTellsTheErrorItMakes) {
  const double nees = StreetNees(0.0);
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2.0);
}

// Posts in this scene look the same from all sides, which the covariance does not count on.
TEST(NdtMatcher, VerticalStructuresAreNotTrustedMoreThanTheyTell) {
  const double nees = StreetNees(1.0);
  EXPECT_GT(nees, 0.2);
  EXPECT_LT(nees, 1.5);
}

// The road has posts and no other vertical objects: only they determine the position along it.
TEST(NdtMatcher, PostsHoldAlongAnOpenRoadWhereTheShiftIsUnknown) {
  const auto result_with = [](double shift_std_m) {
    NdtMatcherIn road(test::RoadWithPosts());
    road.shift_std_m = shift_std_m;
    road.InsertRoad(0.0, 20.0);
    return road.MatchFrom(OnRoad(12.4), 0.2 * Vector6::Unit(0), 0.2);
  };
  const MatchResult held = result_with(1.0);
  ASSERT_TRUE(held.IsUsable());
  EXPECT_LT(ErrorOf(held, OnRoad(12.4)).head<2>().norm(), 0.05);
  EXPECT_EQ(held.degenerate_mask, 0u);
  EXPECT_NE(result_with(0.0).degenerate_mask, 0u);
}

// All that stands went along with the vehicle, by 0.3 m, as cars do at a green light.
TEST(NdtMatcher, ThingsThatContradictAKnownShiftAreLeftOut) {
  const auto error_along_m = [](double shift_std_m) {
    NdtMatcherIn road(test::RoadWithPosts());
    road.shift_std_m = shift_std_m;
    road.InsertRoad(0.0, 20.0);
    const MatchResult result = road.MatchFrom(OnRoad(12.4), 0.3 * Vector6::Unit(0), 0.02);
    return std::abs((OnRoad(12.4).Inverse() * result.T_map_imu).translation.x());
  };
  EXPECT_LT(error_along_m(1.0), 0.05);
  EXPECT_NEAR(error_along_m(0.01), 0.3, 0.05);
}

TEST(NdtMatcher, CorridorHasOneDegenerateDirectionAlongItsAxis) {
  NdtMatcherIn corridor(test::Corridor());
  for (double x = 0.0; x <= 10.0; x += 1.0) corridor.InsertFrom({ExpSo3({0, 0, 0.3}), {x, 0, 0}});
  const Pose truth{ExpSo3({0, 0, 0.3}), {5.4, 0.3, 0.0}};
  Vector6 guess_error = Vector6::Zero();
  guess_error.head<3>() = truth.rotation.conjugate() * Vector3(0.2, 0.05, 0.02);
  const MatchResult result = corridor.MatchFrom(truth, guess_error, 0.2);
  ASSERT_EQ(result.status, MatchStatus::kDegenerate);
  EXPECT_TRUE(result.IsUsable());
  EXPECT_EQ(result.degenerate_mask, 1u);
  const Matrix3 R = truth.rotation.toRotationMatrix();
  const Matrix3 cov_world = R * result.cov.topLeftCorner<3, 3>() * R.transpose();
  EXPECT_GT(cov_world(0, 0), 50.0 * 50.0);
  const Matrix3 known = cov_world.inverse();  // given the two others: the degenerate one leans
  EXPECT_GT(known(1, 1), 1 / (0.02 * 0.02));
  EXPECT_GT(known(2, 2), 1 / (0.02 * 0.02));
  const Matrix3 held_world = R * result.observable_cov.topLeftCorner<3, 3>() * R.transpose();
  EXPECT_LT(held_world(0, 0), 0.02 * 0.02);
  // Observable directions are corrected, the degenerate one stays where the guess was.
  const Vector3 error = result.T_map_imu.translation - truth.translation;
  EXPECT_NEAR(error.x(), 0.2, 0.02);
  EXPECT_NEAR(error.y(), 0.0, 0.01);
  EXPECT_NEAR(error.z(), 0.0, 0.01);
}

// It does not contain what all matches of a map have in common, such as the slope that rings give
// to their cells.
TEST(NdtMatcher, TellsHowMuchTheDirectionThatItDoesNotSeeVaries) {
  constexpr int kRuns = 40;
  NdtMatcherIn corridor(test::Corridor());
  for (double x = 0.0; x <= 10.0; x += 1.0) corridor.InsertFrom({ExpSo3({0, 0, 0.3}), {x, 0, 0}});
  Eigen::Matrix<double, 3, kRuns> found;
  Vector3 told_var = Vector3::Zero();
  for (int i = 0; i < kRuns; ++i) {
    const Pose truth{ExpSo3({0, 0.01 * (i % 3), 0.3}), {3.0 + 0.1 * i, 0.2, 0.0}};
    const MatchResult result = corridor.MatchFrom(truth, Vector6::Zero(), 0.02);
    ASSERT_EQ(result.blind_directions.size(), 1u);
    const BlindDirection& blind = result.blind_directions.front();
    EXPECT_NEAR(blind.weight.dot(blind.shift), 1.0, 1e-9);
    const Vector3 along = truth.rotation * blind.shift.head<3>();
    found.col(i) = along / along.x();
    const Matrix3 R = truth.rotation.toRotationMatrix();
    const Matrix3 told = R * blind.cov.topLeftCorner<3, 3>() * R.transpose();
    told_var += told.diagonal() / kRuns;
  }
  const Eigen::Matrix<double, 3, kRuns> apart = found.colwise() - found.rowwise().mean();
  for (int axis = 1; axis < 3; ++axis) {
    const double seen_var = apart.row(axis).squaredNorm() / (kRuns - 1);
    EXPECT_GT(seen_var, told_var[axis] / 16.0) << axis;
    EXPECT_LT(seen_var, told_var[axis] * 9.0) << axis;
  }
}

TEST(NdtMatcher, TellsTheSupportAtAGuessThatThePoseContradicts) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 20.0);
  const Pose truth = OnRoad(12.4);
  Vector6 error = Vector6::Zero();
  error[1] = 0.2;
  const MatchResult contradicted = street.MatchFrom(truth, error, 0.005);
  ASSERT_TRUE(contradicted.IsUsable());
  ASSERT_TRUE(contradicted.support_at_guess);
  EXPECT_GT(*contradicted.support_at_guess, 0.0);
  EXPECT_LT(*contradicted.support_at_guess, 0.9);
  const MatchResult within = street.MatchFrom(truth, error, 0.2);
  ASSERT_TRUE(within.IsUsable());
  EXPECT_FALSE(within.support_at_guess);
}

// Along a corridor the guess stays where it is.
TEST(NdtMatcher, AGuessAlongADirectionThatIsOpenIsNotContradicted) {
  NdtMatcherIn corridor(test::Corridor());
  for (double x = 0.0; x <= 10.0; x += 1.0) {
    corridor.InsertFrom({Quaternion::Identity(), {x, 0, 0}});
  }
  Vector6 error = Vector6::Zero();
  error[0] = 0.2;
  const MatchResult result =
      corridor.MatchFrom({Quaternion::Identity(), {5.4, 0.3, 0.0}}, error, 0.005);
  ASSERT_EQ(result.status, MatchStatus::kDegenerate);
  EXPECT_FALSE(result.support_at_guess);
}

}  // namespace
}  // namespace lio
