// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/degenerate_directions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <random>

#include "support/random_state.hpp"

namespace lio {
namespace {

// Returns the information of a scene that makes every direction observable; rotations have another
// unit than translations.
Matrix6 FullInformation(std::mt19937_64& random) {
  Vector6 scale;
  scale << 100, 100, 100, 2000, 2000, 2000;
  return scale.asDiagonal() * test::RandomCovariance<6>(random, 1.0) * scale.asDiagonal();
}

Matrix6 SmallNoise() {
  return 1e-3 * Matrix6::Identity();
}

// Removes all information along `direction`.
Matrix6 Without(const Matrix6& information, const Vector6& direction) {
  const Vector6 lost = information * direction;
  return information - lost * lost.transpose() / direction.dot(lost);
}

TEST(DegenerateDirections, FullInformationHasNone) {
  std::mt19937_64 random(1);
  const DirectionSplit split = SplitDirections(FullInformation(random), SmallNoise());
  EXPECT_EQ(split.degenerate_mask, 0u);
  EXPECT_EQ(split.num_degenerate(), 0);
  EXPECT_TRUE(DegenerateCovariance(split).isZero());
  EXPECT_TRUE((split.eigenvalues.tail<5>().array() >= split.eigenvalues.head<5>().array()).all());
}

TEST(DegenerateDirections, MetresPerRadAreTheLeverOfTheMatchedPoints) {
  Matrix6 information = Matrix6::Zero();
  const Vector3 normal(0, 0, 1);
  for (const Vector3& point : {Vector3(3, 0, 7), Vector3(0, 4, 1), Vector3(-5, 0, 2)}) {
    Vector6 row;
    row << normal, point.cross(normal);
    information += 100.0 * row * row.transpose();
  }
  EXPECT_NEAR(MetresPerRad(information), std::sqrt((9.0 + 16.0 + 25.0) / 3.0), 1e-12);
  EXPECT_EQ(MetresPerRad(Matrix6::Zero()), 1.0);
  EXPECT_EQ(SplitDirections(information, SmallNoise()).metres_per_rad, MetresPerRad(information));
}

TEST(DegenerateDirections, StepIsGaussNewtonsWhereAllIsObservable) {
  std::mt19937_64 random(2);
  const Matrix6 H = FullInformation(random);
  const Vector6 g = test::RandomVector<6>(random);
  const Vector6 expected = -H.ldlt().solve(g);
  const Vector6 step = StepInObservableDirections(SplitDirections(H, SmallNoise()), g);
  EXPECT_LT((step - expected).norm(), 1e-9 * expected.norm());
}

TEST(DegenerateDirections, CovarianceIsTheSandwichWhereAllIsObservable) {
  std::mt19937_64 random(3);
  const Matrix6 H = FullInformation(random);
  const Matrix6 scores = FullInformation(random);
  const Matrix6 expected = H.inverse() * scores * H.inverse();
  const Matrix6 cov =
      CovarianceFromScores(ObservableInverse(SplitDirections(H, SmallNoise())), scores);
  EXPECT_LT((cov - expected).norm(), 1e-9 * expected.norm());
}

TEST(DegenerateDirections, DirectionWithoutInformationIsDegenerateAndNotStepped) {
  std::mt19937_64 random(4);
  Vector6 along = Vector6::Zero();
  along.head<3>() = Vector3(1, 2, -1).normalized();
  const Matrix6 H = Without(FullInformation(random), along);
  const DirectionSplit split = SplitDirections(H, SmallNoise());
  ASSERT_EQ(split.num_degenerate(), 1);
  EXPECT_EQ(split.degenerate_mask, 1u);  // eigenvalues ascend: the first one

  const Vector6 gradient = H * test::RandomVector<6>(random);
  const Vector6 step = StepInObservableDirections(split, gradient);
  EXPECT_LT((H * step + gradient).norm(), 1e-6 * gradient.norm()) << "solved where it is held";
  const Vector6 scaled_step = split.Scale().cwiseProduct(step);
  EXPECT_NEAR(scaled_step.dot(split.directions.col(0)), 0.0, 1e-9);
}

TEST(DegenerateDirections, DegenerateDirectionHasALargeVariance) {
  std::mt19937_64 random(5);
  const Vector6 along = Vector6::Unit(0);
  const Matrix6 H = Without(FullInformation(random), along);
  const DirectionSplit split = SplitDirections(H, SmallNoise());
  const Matrix6 weak = DegenerateCovariance(split);
  EXPECT_GT(weak(0, 0), 1e3);  // nearly (100 m)^2: a part of the direction is rotation
  EXPECT_LT((H * weak).norm(), 1e-6 * H.norm() * weak.norm()) << "along the weak one alone";
  const Matrix6 held = CovarianceFromScores(ObservableInverse(split), H);
  const Vector6 v = split.Scale().cwiseProduct(split.directions.col(0));
  EXPECT_LT(std::abs(v.dot(held * v)), 1e-9);
}

// The information is compared with the noise-induced one; its size alone does not matter.
TEST(DegenerateDirections, InformationBelowTheNoisesIsDegenerate) {
  const Matrix6 H = 1e4 * Matrix6::Identity();
  Matrix6 noise_information = Matrix6::Identity();
  EXPECT_EQ(SplitDirections(H, noise_information).num_degenerate(), 0);
  noise_information(1, 1) = 0.5e4;
  const DirectionSplit split =
      SplitDirections(H + Matrix6(Vector6::Unit(1).asDiagonal()), noise_information);
  EXPECT_EQ(split.num_degenerate(), 1);
  EXPECT_GT(DegenerateCovariance(split)(1, 1), 9e3);
  EXPECT_NEAR(DegenerateCovariance(split)(0, 0), 0.0, 1e-9);
}

TEST(DegenerateDirections, NoInformationAtAllIsAllDegenerate) {
  const DirectionSplit split = SplitDirections(Matrix6::Zero(), Matrix6::Zero());
  EXPECT_EQ(split.num_degenerate(), 6);
  EXPECT_TRUE(StepInObservableDirections(split, Vector6::Ones()).isZero());
  EXPECT_TRUE(ObservableInverse(split).isZero());
}

// In a tunnel the axis may have as much information by noise as another direction has by the scene.
// Eigenvectors of the information are then any mixture of the two.
TEST(DegenerateDirections, ADirectionOfNoiseIsFoundBesideOneOfTheSameInformation) {
  std::mt19937_64 random(7);
  Matrix6 noise = SmallNoise();
  noise(0, 0) = 0.9e4;  // nearly all information along x is noise's
  for (const double excess : {-10.0, -1e-9, 0.0, 1e-9, 10.0}) {
    Vector6 information = Vector6::Constant(1e6);
    information[0] = 1e4;
    information[1] = 1e4 + excess;
    const DirectionSplit split = SplitDirections(information.asDiagonal(), noise);
    ASSERT_EQ(split.num_degenerate(), 1) << excess;
    const Matrix6 cov = DegenerateCovariance(split);
    EXPECT_GT(cov(0, 0), 9e3) << excess;
    EXPECT_LT(cov.diagonal().tail<5>().maxCoeff(), 1.0) << excess;
    const Vector6 step = StepInObservableDirections(split, Vector6::Constant(1e4));
    EXPECT_NEAR(step[0], 0.0, 1e-3) << excess;
    EXPECT_NEAR(step[1], -1.0, 1e-2) << excess;
  }
}

TEST(DegenerateDirections, UnitOfRotationsDoesNotMatter) {
  std::mt19937_64 random(6);
  const Matrix6 H = Without(FullInformation(random), Vector6::Unit(0));
  Vector6 unit;
  unit << 1, 1, 1, 50, 50, 50;
  const Matrix6 in_unit = unit.asDiagonal() * H * unit.asDiagonal();
  const DirectionSplit a = SplitDirections(H, SmallNoise());
  const DirectionSplit b =
      SplitDirections(in_unit, unit.asDiagonal() * SmallNoise() * unit.asDiagonal());
  EXPECT_EQ(a.degenerate_mask, b.degenerate_mask);
  EXPECT_LT((a.eigenvalues - b.eigenvalues).norm(), 1e-9 * a.eigenvalues.norm());
}

TEST(DegenerateDirections, LeastRatioIsThatOfTheDirectionThatIsShownLeast) {
  std::mt19937_64 random(21);
  const Matrix6 H = FullInformation(random);
  EXPECT_EQ(LeastInformationRatio(Matrix6::Zero(), SmallNoise()), 0.0);
  EXPECT_NEAR(LeastInformationRatio(3.0 * H, H), 3.0, 1e-6);
  EXPECT_LT(LeastInformationRatio(Without(H, Vector6::Unit(2)), H), 1e-6);
}

// The step leads to the least of cost and prior in one, since both are quadratic.
TEST(DegenerateDirections, StepTowardsTheGuessMinimisesCostAndPrior) {
  std::mt19937_64 random(22);
  const Matrix6 H = Without(FullInformation(random), Vector6::Unit(0));
  const Vector6 g = H * Vector6::Constant(0.01);
  const Matrix6 guess_cov = test::RandomCovariance<6>(random, 0.1);
  const Vector6 off = 1e-4 * test::RandomVector<6>(random);
  const Vector6 step = StepTowardsGuess(H, g, {ExpSe3(off), guess_cov});
  const Vector6 gradient_after = g + H * step + guess_cov.ldlt().solve(off + step);
  EXPECT_LT(gradient_after.norm(), 1e-6 * g.norm());
  EXPECT_TRUE(step.allFinite());
}

}  // namespace
}  // namespace lio
