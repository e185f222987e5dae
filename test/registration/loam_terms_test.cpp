// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "registration/example_pose.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::kLoamTruth;

// Returns noisy points of three walls and a post, as terms of 12 parts.
class LoamTermsTest : public ::testing::Test {
 protected:
  LoamTermsTest() { AddWorld(0.02); }

  void AddWorld(double noise_m) {
    terms_.Clear();
    points_.clear();
    std::mt19937_64 random(11);
    for (int i = 0; i < 120; ++i) {
      const int axis = i % 3;
      Vector3 at = 4.0 * test::RandomVector<3>(random);
      at[axis] = 5.0;
      AddPlane(at, axis, at + noise_m * test::RandomVector<3>(random), i % 8);
      const Vector3 on_post(3, 4, test::RandomVector<1>(random)[0]);
      AddEdge(on_post, on_post + noise_m * test::RandomVector<3>(random), 8 + i % 4);
    }
  }
  void AddPlane(const Vector3& on_plane, int axis, const Vector3& seen, int part) {
    PlaneTerm term;
    term.point = static_cast<std::int32_t>(points_.size());
    term.part = part;
    term.on_plane = on_plane;
    term.axes << Vector3::Unit(axis), Vector3::Unit((axis + 1) % 3), Vector3::Unit((axis + 2) % 3);
    term.normal_var = {1e-4, 2e-4};
    terms_.Add(term);
    points_.push_back((kLoamTruth.Inverse() * seen).cast<float>());
  }
  void AddEdge(const Vector3& on_line, const Vector3& seen, int part) {
    EdgeTerm term;
    term.point = static_cast<std::int32_t>(points_.size());
    term.part = part;
    term.on_line = on_line;
    term.direction = Vector3::UnitZ();
    term.direction_var = 1e-3;
    terms_.Add(term);
    points_.push_back((kLoamTruth.Inverse() * seen).cast<float>());
  }
  MatchSums LinearizeAt(const Pose& pose) {
    scores_.Reset(12, Pose::Identity());
    return terms_.Linearize(points_, pose, &scores_);
  }

  LoamOptions options_;
  LoamTerms terms_{options_};
  std::vector<Eigen::Vector3f> points_;
  MatchScores scores_;
};

// The gradient is taken by central differences of the cost with constant weights.
TEST_F(LoamTermsTest, GradientAndInformationAreTheCostsDerivatives) {
  const Pose at = kLoamTruth * ExpSe3(0.01 * Vector6::Ones());
  const MatchSums sums = LinearizeAt(at);
  const auto gradient_at = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    const Pose pose = at * ExpSe3(Vector6(d));
    const auto cost = [&](const Eigen::VectorXd& e) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(
          1, terms_.FixedCorrespondenceCost(points_, pose * ExpSe3(Vector6(e))));
    };
    return test::NumericJacobian(cost, Vector6::Zero(), 1e-4).transpose();
  };
  const Vector6 numeric = gradient_at(Vector6::Zero());
  EXPECT_LT((sums.gradient - numeric).norm(), 1e-3 * numeric.norm());
  const Matrix6 information = sums.information.Full();
  const Eigen::MatrixXd hessian = test::NumericJacobian(gradient_at, Vector6::Zero(), 1e-3);
  EXPECT_LT((information - hessian).norm(), 0.02 * information.norm());
}

TEST_F(LoamTermsTest, ScoresOfThePartsMakeTheGradient) {
  const MatchSums sums = LinearizeAt(kLoamTruth * ExpSe3(0.01 * Vector6::Ones()));
  EXPECT_EQ(sums.num_matched, 240);
  // The square of a single part is the gradient's.
  LoamTerms one(options_);
  for (PlaneTerm term : terms_.planes()) {
    term.part = 0;
    one.Add(term);
  }
  scores_.Reset(1, Pose::Identity());
  const MatchSums of_one =
      one.Linearize(points_, kLoamTruth * ExpSe3(0.01 * Vector6::Ones()), &scores_);
  const Matrix6 square = of_one.gradient * of_one.gradient.transpose();
  EXPECT_LT((scores_.Covariance() - square).norm(), 1e-4 * square.norm());
}

// A point that is 5 times Huber's limit off has a weight of a fifth and adds no curvature, and its
// residual is weighted.
TEST_F(LoamTermsTest, FarPointsWeighByHubersRule) {
  terms_.Clear();
  points_.clear();
  AddPlane({5, 0, 0}, 0, {5.0 + 5.0 * options_.huber_m, 0, 0}, 0);
  const MatchSums sums = LinearizeAt(kLoamTruth);
  const double full = 1.0 / (options_.surface_std_m * options_.surface_std_m);
  EXPECT_NEAR(terms_.planes()[0].weight, 0.2 * full, 1e-3);
  EXPECT_NEAR(sums.weight_sum, 0.2, 1e-5);
  EXPECT_EQ(sums.curvature_sum, 0.0);
  EXPECT_NEAR(sums.information_sum, 0.2 * full, 1e-3);
  EXPECT_NEAR(sums.residual_sq_sum, 0.2 * 0.25, 1e-5);
}

TEST_F(LoamTermsTest, EdgesWeighByTheirOwnAccuracyAndHoldTwoDirections) {
  terms_.Clear();
  points_.clear();
  AddEdge({3, 4, 0}, {3.03, 4.04, 0.7}, 0);
  const MatchSums sums = LinearizeAt(kLoamTruth);
  const double weight = 1.0 / (options_.edge_std_m * options_.edge_std_m);
  EXPECT_NEAR(terms_.edges()[0].weight, weight, 1e-6);
  const Matrix3 R = kLoamTruth.rotation.toRotationMatrix();
  const Matrix3 in_map = R * sums.information.Full().topLeftCorner<3, 3>() * R.transpose();
  EXPECT_NEAR(in_map(0, 0), weight, 1e-3);
  EXPECT_NEAR(in_map(1, 1), weight, 1e-3);
  EXPECT_NEAR(in_map(2, 2), 0.0, 1e-3);
  EXPECT_NEAR(sums.residual_sq_sum, 0.5 * 0.05 * 0.05, 1e-6);  // a mean of two directions
  // The cost is the squared distance of 5 cm, halved.
  EXPECT_NEAR(terms_.FixedCorrespondenceCost(points_, kLoamTruth), 0.5 * weight * 0.05 * 0.05,
              1e-4);
}

TEST_F(LoamTermsTest, SolvesToThePoseThatMadeThePoints) {
  AddWorld(0.0);
  LinearizeAt(kLoamTruth);
  Pose pose = kLoamTruth * ExpSe3(0.05 * Vector6::Ones());
  for (int round = 0; round < 3; ++round) pose = terms_.Solve(points_, {}, pose);
  EXPECT_LT(LogSe3(kLoamTruth.Inverse() * pose).norm(), 1e-5);
  EXPECT_LT(terms_.FixedCorrespondenceCost(points_, pose), 1e-6);
}

TEST_F(LoamTermsTest, ClearedTermsAreGone) {
  EXPECT_EQ(terms_.size(), 240u);
  terms_.Clear();
  EXPECT_EQ(terms_.size(), 0u);
  EXPECT_EQ(LinearizeAt(kLoamTruth).num_matched, 0);
  EXPECT_EQ(terms_.FixedCorrespondenceCost(points_, kLoamTruth), 0.0);
}

}  // namespace
}  // namespace lio
