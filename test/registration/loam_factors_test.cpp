// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_factors.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "registration/pose_manifold.hpp"
#include "support/numeric_jacobian.hpp"

namespace lio {
namespace {

using Tangent = Eigen::Matrix<double, Eigen::Dynamic, 6>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3 Point(double size) {
    return {Uniform(-size, size), Uniform(-size, size), Uniform(-size, size)};
  }
  Pose NextPose(double angle) { return {ExpSo3(Point(angle)), Point(20.0)}; }

 private:
  std::mt19937 engine_;
};

// Returns poses of all kinds: identity, nearly identity, small and large rotations.
std::vector<Pose> UniformPoses() {
  Random random(3);
  std::vector<Pose> poses{Pose::Identity(), {ExpSo3(Vector3(1e-9, -2e-9, 1e-9)), Vector3::Zero()}};
  for (const double angle : {1e-6, 1e-3, 0.1, 1.0, 1.8}) {
    for (int i = 0; i < 20; ++i) poses.push_back(random.NextPose(angle));
  }
  return poses;
}

CostPtr MakeEdge(const Vector3& point, const Vector3& a, const Vector3& b) {
  return std::make_unique<EdgeFactor>(point, a, b);
}

CostPtr MakePlane(const Vector3& point, const Vector3& normal, double offset) {
  return std::make_unique<PlaneFactor>(point, normal, offset);
}

Eigen::VectorXd Residual(const ceres::CostFunction& cost, const Pose& pose) {
  const PoseBlock block = ToBlock(pose);
  const double* blocks[] = {block.data()};
  Eigen::VectorXd residual(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), nullptr));
  return residual;
}

// Returns the derivative in the six tangent dimensions, as Ceres makes it from the ambient one and
// the manifold.
Tangent TangentJacobian(const ceres::CostFunction& cost, const Pose& pose) {
  const PoseBlock block = ToBlock(pose);
  const double* blocks[] = {block.data()};
  Eigen::VectorXd residual(cost.num_residuals());
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> ambient(cost.num_residuals(), 7);
  double* jacobians[] = {ambient.data()};
  EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), jacobians));
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  EXPECT_TRUE(PoseManifold().PlusJacobian(block.data(), plus.data()));
  return ambient * plus;
}

struct Pair {
  CostPtr analytic;
  CostPtr automatic;
};

std::vector<Pair> RandomPairs(unsigned seed) {
  Random random(seed);
  std::vector<Pair> pairs;
  const Vector3 point = random.Point(50);
  const Vector3 a = random.Point(50);
  const Vector3 b = a + random.Point(2);
  pairs.push_back({MakeEdge(point, a, b), MakeAutoEdge(point, a, b)});
  const Vector3 normal = random.Point(1).normalized();
  const double offset = random.Uniform(-30, 30);
  pairs.push_back({MakePlane(point, normal, offset), MakeAutoPlane(point, normal, offset)});
  return pairs;
}

TEST(LoamFactors, AnalyticAndAutomaticJacobiansAgree) {
  unsigned seed = 0;
  for (const Pose& pose : UniformPoses()) {
    for (const Pair& pair : RandomPairs(++seed)) {
      const Tangent analytic = TangentJacobian(*pair.analytic, pose);
      const Tangent automatic = TangentJacobian(*pair.automatic, pose);
      EXPECT_LE((analytic - automatic).norm(), 1e-9 * automatic.norm());
      EXPECT_LE((Residual(*pair.analytic, pose) - Residual(*pair.automatic, pose)).norm(),
                1e-11 * (1 + Residual(*pair.automatic, pose).norm()));
    }
  }
}

TEST(LoamFactors, JacobiansAreThoseOfTheRightPerturbation) {
  Random random(5);
  for (const Pose& pose : UniformPoses()) {
    const Vector3 point = random.Point(10);
    const Vector3 a = random.Point(10);
    const Vector3 b = random.Point(10);
    const Vector3 c = random.Point(10);
    std::vector<CostPtr> costs;
    for (const double s : {1.0, 0.7, 0.0}) {
      costs.push_back(MakeAutoEdge(point, a, b, s));
      costs.push_back(MakeAutoPlaneByPoints(point, a, b, c, s));
      costs.push_back(MakeAutoPlane(point, (a - b).normalized(), 3.0, s));
      costs.push_back(MakeAutoPoint(point, a, s));
    }
    costs.push_back(MakeEdge(point, a, b));
    costs.push_back(MakePlane(point, (a - b).normalized(), 3.0));
    for (const CostPtr& cost : costs) {
      const auto f = [&](const Eigen::VectorXd& d) {
        return Residual(*cost, pose * ExpSe3(Vector6(d)));
      };
      const Eigen::MatrixXd numeric = test::NumericJacobian(f, Eigen::VectorXd::Zero(6), 1e-5);
      EXPECT_LE((TangentJacobian(*cost, pose) - numeric).norm(), 1e-6 * (1 + numeric.norm()));
    }
  }
}

TEST(LoamFactors, ResidualsAreDistances) {
  const Pose pose{ExpSo3(Vector3(0.1, -0.3, 0.2)), Vector3(1, 2, 3)};
  const Vector3 point(4, -5, 6);
  const Vector3 moved = pose * point;
  const Vector3 along = Vector3(1, 2, -1).normalized();
  const Vector3 aside = along.unitOrthogonal();
  const Vector3 a = moved + 0.3 * aside - 2 * along;
  for (const CostPtr& edge :
       {MakeEdge(point, a, a + 7 * along), MakeAutoEdge(point, a, a - along)}) {
    EXPECT_NEAR(Residual(*edge, pose).norm(), 0.3, 1e-12);
  }
  const Vector3 foot = moved + 0.4 * aside;
  const CostPtr plane = MakeAutoPlaneByPoints(point, foot, foot + along, foot + along.cross(aside));
  EXPECT_NEAR(std::abs(Residual(*plane, pose)[0]), 0.4, 1e-12);
  EXPECT_NEAR(Residual(*MakePlane(point, aside, -aside.dot(foot)), pose)[0], -0.4, 1e-12);
  EXPECT_NEAR((Residual(*MakeAutoPoint(point, foot), pose) + 0.4 * aside).norm(), 0, 1e-12);
}

TEST(LoamFactors, SweepRatioTakesThatPartOfTheMotion) {
  const Pose motion{ExpSo3(Vector3(0, 0, 0.6)), Vector3(2, 0, 0)};
  const Vector3 point(5, 1, 0);
  const Pose half{ExpSo3(Vector3(0, 0, 0.3)), Vector3(1, 0, 0)};
  EXPECT_NEAR(Residual(*MakeAutoPoint(point, half * point, 0.5), motion).norm(), 0, 1e-12);
  EXPECT_NEAR(Residual(*MakeAutoPoint(point, point, 0.0), motion).norm(), 0, 1e-12);
  EXPECT_NEAR(Residual(*MakeAutoPoint(point, motion * point, 1.0), motion).norm(), 0, 1e-12);
}

TEST(LoamFactors, EdgeIsSmoothOnTheLineItself) {
  const Vector3 a(1, 0, 0);
  const Vector3 b(3, 0, 0);
  const Vector3 on_line(2, 0, 0);
  for (const CostPtr& edge : {MakeEdge(on_line, a, b), MakeAutoEdge(on_line, a, b)}) {
    EXPECT_EQ(Residual(*edge, Pose::Identity()).norm(), 0.0);
    const Tangent jacobian = TangentJacobian(*edge, Pose::Identity());
    EXPECT_TRUE(jacobian.allFinite());
    EXPECT_NEAR(jacobian.leftCols<3>().norm(), std::sqrt(2.0), 1e-12);
  }
}

TEST(LoamFactors, ShortLinesAndNarrowTrianglesAreRefused) {
  const Vector3 point(1, 2, 3);
  const Vector3 a(4, 5, 6);
  EXPECT_EQ(MakeAutoEdge(point, a, a + Vector3(0.0099, 0, 0)), nullptr);
  EXPECT_EQ(MakeAutoEdge(point, a, a), nullptr);
  EXPECT_NE(MakeAutoEdge(point, a, a + Vector3(0.0101, 0, 0)), nullptr);
  const Vector3 step(1, 0.5, 0);
  EXPECT_EQ(MakeAutoPlaneByPoints(point, a, a + step, a + 2 * step), nullptr);
}

// Points on three walls, a post and two marks are seen from elsewhere: the solver must find from
// where.
TEST(LoamFactors, SolverFindsThePoseThatMadeThePoints) {
  Random random(11);
  const Pose truth{ExpSo3(Vector3(0.05, -0.1, 0.3)), Vector3(0.5, -0.8, 0.2)};
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss huber(0.1);
  PoseManifold manifold;
  PoseBlock block = ToBlock(Pose::Identity());
  ceres::Problem problem(options);
  problem.AddParameterBlock(block.data(), 7, &manifold);
  const auto add = [&](CostPtr cost) {
    problem.AddResidualBlock(cost.release(), &huber, block.data());
  };
  for (int i = 0; i < 60; ++i) {
    const Vector3 normal = Vector3::Unit(i % 3);
    Vector3 on_plane = random.Point(10);
    on_plane[i % 3] = 5.0;
    add(MakePlane(truth.Inverse() * on_plane, normal, -5.0));
    const Vector3 on_post(3, 4, random.Uniform(-2, 2));
    add(MakeEdge(truth.Inverse() * on_post, Vector3(3, 4, -1), Vector3(3, 4, 1)));
  }
  const Vector3 mark(-3, 2, 1);
  add(MakeAutoPoint(truth.Inverse() * mark, mark));
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 30;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  EXPECT_LE(LogSe3(truth.Inverse() * ToPose(block.data())).norm(), 1e-6);
}

}  // namespace
}  // namespace lio
