// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_solver.hpp"

#include <gtest/gtest.h>

#include <random>

#include "registration/example_pose.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::kLoamTruth;

double ErrorOf(const Pose& pose) {
  return LogSe3(kLoamTruth.Inverse() * pose).norm();
}

// Returns points of three walls and a post, seen from the truth; those of a sweep ratio below 1 are
// seen from that part of the way to it.
class LoamSolverTest : public ::testing::Test {
 protected:
  void AddWorld(double ratio = 1.0) {
    const Pose seen_from = Interpolate(Pose::Identity(), kLoamTruth, ratio);
    for (int i = 0; i < 60; ++i) {
      const int axis = i % 3;
      Vector3 on_wall = 4.0 * test::RandomVector<3>(random_);
      on_wall[axis] = 5.0;
      solver_.AddPlane(seen_from.Inverse() * on_wall, Vector3::Unit(axis), -5.0, ratio);
      const Vector3 on_post(3, 4, test::RandomVector<1>(random_)[0]);
      solver_.AddEdge(seen_from.Inverse() * on_post, Vector3(3, 4, -1), Vector3(3, 4, 1), ratio);
    }
  }
  static LoamSolverOptions Patient() {
    LoamSolverOptions options;
    options.max_iterations = 50;
    return options;
  }
  std::mt19937_64 random_{11};
  LoamSolver solver_;
};

TEST_F(LoamSolverTest, FindsThePoseThatMadeThePoints) {
  AddWorld();
  EXPECT_LT(ErrorOf(solver_.Solve(Pose::Identity(), Patient())), 1e-5);
}

TEST_F(LoamSolverTest, APointOfHalfTheSweepTakesHalfTheMotion) {
  AddWorld(0.5);
  EXPECT_LT(ErrorOf(solver_.Solve(Pose::Identity(), Patient())), 1e-4);
}

TEST_F(LoamSolverTest, WithoutIterationsThePoseStays) {
  AddWorld();
  LoamSolverOptions options;
  options.max_iterations = 0;
  EXPECT_NEAR(ErrorOf(solver_.Solve(Pose::Identity(), options)), ErrorOf(Pose::Identity()), 1e-12);
}

TEST_F(LoamSolverTest, EachIterationComesNearer) {
  AddWorld();
  LoamSolverOptions options;
  double before = ErrorOf(Pose::Identity());
  for (options.max_iterations = 1; options.max_iterations <= 3; ++options.max_iterations) {
    const double now = ErrorOf(solver_.Solve(Pose::Identity(), options));
    EXPECT_LT(now, before);
    before = now;
  }
}

// A fifth of the walls' points are a metre off: with Huber's loss they pull as if 0.1 m off.
TEST_F(LoamSolverTest, OutliersPullNoMoreThanHubersLossLets) {
  AddWorld();
  for (int i = 0; i < 12; ++i) {
    const Vector3 wrong(5.0 - 1.0, i, 0.1 * i * i);
    solver_.AddPlane(kLoamTruth.Inverse() * wrong, Vector3::UnitX(), -5.0, 1.0);
  }
  LoamSolverOptions options = Patient();
  const double robust = ErrorOf(solver_.Solve(Pose::Identity(), options));
  options.huber_m = 1e6;
  const double plain = ErrorOf(solver_.Solve(Pose::Identity(), options));
  EXPECT_LT(robust, 0.1);
  EXPECT_GT(plain, 2.0 * robust);
}

// Edges and planes disagree: the side of greater weight wins.
TEST_F(LoamSolverTest, EdgesWeighAsMuchAsTheyAreTold) {
  AddWorld();
  for (int i = 0; i < 60; ++i) {
    // Adds another post, moved by 5 cm along x.
    const Vector3 seen(-3.0 + 0.05, -4, 0.1 * i - 3);
    solver_.AddEdge(kLoamTruth.Inverse() * seen, Vector3(-3, -4, -1), Vector3(-3, -4, 1), 1.0);
  }
  LoamSolverOptions options = Patient();
  options.edge_weight = 1e-4;
  const double light = ErrorOf(solver_.Solve(Pose::Identity(), options));
  options.edge_weight = 1.0;
  EXPECT_GT(ErrorOf(solver_.Solve(Pose::Identity(), options)), 10.0 * light);
  EXPECT_LT(light, 1e-3);
}

TEST_F(LoamSolverTest, AClearedOneHasNothingToSay) {
  AddWorld();
  AddWorld(0.5);
  solver_.Clear();
  EXPECT_NEAR(ErrorOf(solver_.Solve(kLoamTruth, {})), 0.0, 1e-12);
  EXPECT_NEAR(ErrorOf(solver_.Solve(Pose::Identity(), {})), ErrorOf(Pose::Identity()), 1e-12);
}

}  // namespace
}  // namespace lio
