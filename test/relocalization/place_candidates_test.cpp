// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::PostsSeenFrom;

TEST(PlaceCandidates, AreWhereTheViewsAgreeAndAtLastWhereItWas) {
  const Pose earlier{ExpSo3(Vector3(0, 0, 0.5)), Vector3(1, 2, 0)};
  const Pose now{ExpSo3(Vector3(0, 0, 1.1)), Vector3(8, -1, 0)};
  const Pose expected{ExpSo3(Vector3(0, 0, 0.9)), Vector3(9.5, 0.5, 0)};
  const auto points_then = PostsSeenFrom(earlier);
  const auto points_now = PostsSeenFrom(now);
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << Vector3::Constant(2.0), Vector3::Constant(0.04);
  const std::vector<Pose> guesses = PlaceCandidates({points_then, earlier}, {points_now, expected},
                                                    cov, Quaternion::Identity(), true);
  ASSERT_GE(guesses.size(), 2u);
  const Pose error = now.Inverse() * guesses.front();
  EXPECT_LT(error.translation.norm(), 0.5);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.03);
  EXPECT_EQ(guesses.back().translation, earlier.translation);
}

TEST(PlaceCandidates, OfBareGroundAreOnlyWhereItWas) {
  const std::vector<Eigen::Vector3f> ground{{5.f, 0.f, -1.8f}, {0.f, 5.f, -1.8f}};
  const std::vector<Pose> guesses =
      PlaceCandidates({ground, Pose{}}, {ground, Pose{}}, Matrix6::Identity(),
                      LevelFromMap(Vector3::UnitZ()), true);
  EXPECT_EQ(guesses.size(), 1u);
}

// Rings on the ground move with the sensor, so that the views agree best where it was.
TEST(PlaceCandidates, OfABodyThatWasSeenAreNeverWhereItWas) {
  const auto points = PostsSeenFrom(Pose{});
  Pose prior;
  prior.translation = Vector3(6, 0, 0);
  const Matrix6 cov = 0.01 * Matrix6::Identity();
  const auto nearest_m = [&](bool was_unseen) {
    double nearest = 100.0;
    for (const Pose& guess : PlaceCandidates({points, Pose{}}, {points, prior}, cov,
                                             Quaternion::Identity(), was_unseen)) {
      nearest = std::min(nearest, guess.translation.norm());
    }
    return nearest;
  };
  EXPECT_LT(nearest_m(true), 0.1);
  EXPECT_GT(nearest_m(false), 4.0);
}

}  // namespace
}  // namespace lio
