// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/pose_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "support/map_is_world.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;

constexpr double kNoGate = std::numeric_limits<double>::infinity();

Estimate RandomEstimate(std::mt19937_64& random, double size) {
  Estimate estimate;
  estimate.state = test::RandomState(random);
  estimate.cov = test::RandomCovariance<kStateDim>(random, size);
  return estimate;
}

PoseMeasurement Measure(const Pose& T_map_imu, double std) {
  PoseMeasurement measurement;
  measurement.T_map_imu = T_map_imu;
  measurement.cov = std * std * Matrix6::Identity();
  return measurement;
}

// The residuals go from tiny to half a turn.
std::vector<Vector6> SampleResiduals() {
  std::mt19937_64 random(1);
  std::vector<Vector6> residuals;
  for (const double size : {1e-6, 0.01, 0.3, 1.0}) {
    residuals.push_back(size * test::RandomVector<6>(random));
  }
  return residuals;
}

// Reads d (residual) / d (error of the map pose), as FusePose uses it, off the gain: when the map
// pose's own covariance is zero and only its entry i is correlated with the velocity, a measurement
// that is informative only in its whitened entry j moves the velocity by H(j, i) r_j.
Matrix6 JacobianInUse(const NavState& state, const Vector6& residual) {
  constexpr double kCorrelation = 1e-3;
  Matrix6 H;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      Estimate estimate;
      estimate.state = state;
      estimate.cov(kVel, kMapPose + i) = estimate.cov(kMapPose + i, kVel) = kCorrelation;
      Vector6 variance = Vector6::Constant(1e8);
      variance[j] = 1.0;
      PoseMeasurement measurement;
      measurement.T_map_imu = state.T_map_imu * ExpSe3(residual);
      const Matrix6 whiten = LeftJacobianSe3(-residual);  // the right Jacobian
      measurement.cov = whiten * variance.asDiagonal() * whiten.transpose();
      (void)FusePose(estimate, measurement, kNoGate);
      const double moved = estimate.state.v_world_imu.x() - state.v_world_imu.x();
      H(j, i) = moved / (kCorrelation * residual[j]);
    }
  }
  return H;
}

TEST(PoseUpdate, JacobianMatchesDifferencesOfTheResidual) {
  std::mt19937_64 random(2);
  const NavState state = test::RandomState(random);
  for (const Vector6& residual : SampleResiduals()) {
    const Pose measured = state.T_map_imu * ExpSe3(residual);
    const Eigen::MatrixXd numeric = test::NumericJacobian(
        [&](const Eigen::VectorXd& mu) -> Eigen::VectorXd {
          const Pose T_map_imu = state.T_map_imu * ExpSe3(Vector6(mu));
          return LogSe3(T_map_imu.Inverse() * measured);
        },
        Vector6::Zero());
    // The innovation shrinks as the error is taken out: r(mu) = r - H mu.
    EXPECT_LT((JacobianInUse(state, residual) + numeric).norm(), 1e-5) << residual.transpose();
  }
}

// Errors before an update are about the old nominal state, those after it about the new one.
TEST(PoseUpdate, ResetJacobianMatchesDifferences) {
  std::mt19937_64 random(3);
  const Estimate before = RandomEstimate(random, 0.1);
  // The measurement has no information, and a residual so large that it still moves the state.
  constexpr double kVariance = 1e12;
  const ErrorVector move = 0.3 * test::RandomVector<kStateDim>(random);
  const Eigen::MatrixXd H = before.cov.inverse();
  Estimate after = before;
  FuseLinear(after, H, kVariance * move, kVariance * ErrorMatrix::Identity());
  ASSERT_LT(BoxMinus(after.state, Inject(before.state, move)).norm(), 1e-6);

  const ErrorMatrix reset = test::NumericJacobian(
      [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
        return BoxMinus(Inject(before.state, ErrorVector(error)), after.state);
      },
      move);
  const ErrorMatrix expected = reset * before.cov * reset.transpose();
  EXPECT_LT((after.cov - expected).norm(), 1e-7);
  EXPECT_GT((after.cov - before.cov).norm(), 1e-3) << "the reset must do something here";
}

TEST(PoseUpdate, SureMeasurementIsTakenOver) {
  std::mt19937_64 random(4);
  Estimate estimate = RandomEstimate(random, 0.2);
  const Pose measured = estimate.state.T_map_imu * ExpSe3(0.2 * test::RandomVector<6>(random));
  const UpdateResult result = FusePose(estimate, Measure(measured, 1e-6), kNoGate);
  EXPECT_TRUE(result.fused);
  EXPECT_LT(LogSe3(measured.Inverse() * estimate.state.T_map_imu).norm(), 1e-8);
  EXPECT_LT((estimate.cov.block<6, 6>(kMapPose, kMapPose).diagonal().maxCoeff()), 2e-12);
}

TEST(PoseUpdate, WorldPoseFollowsByItsCorrelation) {
  Estimate estimate;  // both poses alike, their errors one and the same, as after long coasting
  estimate.state.T_world_imu.translation = Vector3(5, 0, 0);
  for (const int at : {kPos, kMapPose}) {
    for (const int to : {kPos, kMapPose}) estimate.cov.block<3, 3>(at, to) = Matrix3::Identity();
  }
  (void)FusePose(estimate, Measure(Pose{Quaternion::Identity(), Vector3(0.5, 0, 0)}, 1.0), kNoGate);
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 0.25, 1e-12);
  EXPECT_NEAR(estimate.state.T_world_imu.translation.x(), 5.25, 1e-12);
}

// After half a minute without scans: both poses have drifted alike by tens of metres and some
// degrees, and where the map lies in world is still known.
TEST(PoseUpdate, ALongDriftThatIsSeenLeavesTheMapInItsPlace) {
  std::mt19937_64 random(8);
  Estimate estimate;
  estimate.state = test::RandomState(random);
  const Matrix3 R_world_imu = estimate.state.T_world_imu.rotation.toRotationMatrix();
  Eigen::Matrix<double, kStateDim, 6> drift = Eigen::Matrix<double, kStateDim, 6>::Zero();
  drift.block<3, 3>(kPos, 0) = R_world_imu;
  drift.block<3, 3>(kRot, 3).setIdentity();
  drift.block<6, 6>(kMapPose, 0).setIdentity();
  const Vector6 drift_std = (Vector6() << 30, 30, 30, 0.05, 0.05, 0.05).finished();
  estimate.cov = drift * drift_std.cwiseAbs2().asDiagonal() * drift.transpose();
  const Pose T_world_map = estimate.state.T_world_imu * estimate.state.T_map_imu.Inverse();
  const Pose seen =
      estimate.state.T_map_imu * ExpSe3((Vector6() << 25, -20, 5, 0.03, -0.02, 0.06).finished());
  (void)FusePose(estimate, Measure(seen, 0.01), kNoGate);
  const Pose after = estimate.state.T_world_imu * estimate.state.T_map_imu.Inverse();
  EXPECT_LT(LogSe3(T_world_map.Inverse() * after).head<3>().norm(), 0.02);
}

TEST(PoseUpdate, UpdateNeverWidensTheCovariance) {
  std::mt19937_64 random(5);
  Estimate estimate = RandomEstimate(random, 0.05);
  const ErrorMatrix before = estimate.cov;
  (void)FusePose(estimate, Measure(estimate.state.T_map_imu, 0.05), kNoGate);
  const Eigen::SelfAdjointEigenSolver<ErrorMatrix> lost(ErrorMatrix(before - estimate.cov));
  EXPECT_GT(lost.eigenvalues().minCoeff(), -1e-15);
  EXPECT_GT(lost.eigenvalues().maxCoeff(), 1e-5);
}

TEST(PoseUpdate, JosephFormKeepsTheCovariancePositiveOverManyUpdates) {
  std::mt19937_64 random(6);
  Estimate estimate = RandomEstimate(random, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Vector6 noise = 1e-4 * test::RandomVector<6>(random);
    (void)FusePose(estimate, Measure(estimate.state.T_map_imu * ExpSe3(noise), 1e-4), kNoGate);
  }
  EXPECT_EQ((estimate.cov - estimate.cov.transpose()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<ErrorMatrix>(estimate.cov).eigenvalues().minCoeff(), 0.0);
}

TEST(PoseUpdate, GatedMeasurementLeavesTheEstimateUntouched) {
  std::mt19937_64 random(7);
  Estimate estimate = RandomEstimate(random, 0.01);
  const Estimate before = estimate;
  const Pose far = estimate.state.T_map_imu * ExpSe3(Vector6::Unit(0));
  const UpdateResult result = FusePose(estimate, Measure(far, 0.01), 22.46);
  EXPECT_FALSE(result.fused);
  EXPECT_GT(result.nis, 22.46);
  EXPECT_EQ(estimate.cov, before.cov);
  EXPECT_EQ(BoxMinus(estimate.state, before.state).norm(), 0.0);
}

TEST(PoseUpdate, NonFiniteMeasurementIsGated) {
  std::mt19937_64 random(8);
  Estimate estimate = RandomEstimate(random, 0.01);
  const Estimate before = estimate;
  Pose broken = estimate.state.T_map_imu;
  broken.translation.x() = std::numeric_limits<double>::quiet_NaN();
  for (const double limit : {22.46, kNoGate}) {
    EXPECT_FALSE(FusePose(estimate, Measure(broken, 0.01), limit).fused);
  }
  EXPECT_EQ(estimate.cov, before.cov);
}

TEST(PoseUpdate, NisOfHonestMeasurementsIsChiSquare) {
  constexpr int kRuns = 2000;
  std::mt19937_64 random(9);
  const Estimate prior = RandomEstimate(random, 0.02);
  const Matrix6 R = test::RandomCovariance<6>(random, 0.02);
  double mean_nis = 0;
  double mean_nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const NavState truth = BoxPlus(prior.state, test::DrawFrom(prior.cov, random));
    PoseMeasurement measurement;
    measurement.T_map_imu = truth.T_map_imu * ExpSe3(test::DrawFrom(R, random));
    measurement.cov = R;
    Estimate estimate = prior;
    mean_nis += FusePose(estimate, measurement, kNoGate).nis / kRuns;
    const ErrorVector error = BoxMinus(truth, estimate.state);
    mean_nees += error.dot(estimate.cov.ldlt().solve(error)) / kRuns;
  }
  // The mean of chi-square with n degrees of freedom over N runs is n +- sqrt(2 n / N); the bar is
  // four of them.
  EXPECT_NEAR(mean_nis, 6.0, 4 * std::sqrt(12.0 / kRuns));
  EXPECT_NEAR(mean_nees, kStateDim, 4 * std::sqrt(2.0 * kStateDim / kRuns));
}

// Blends an estimate and checks that `keep` of the map pose's error stays, and all else.
void ExpectBlendKeeps(const Matrix6& keep, const PoseMeasurement& measurement) {
  std::mt19937_64 random(10);
  Estimate estimate = RandomEstimate(random, 0.1);
  const Estimate before = estimate;
  BlendMapPose(estimate, measurement);
  const Matrix6 expected = keep * before.cov.block<6, 6>(kMapPose, kMapPose) * keep.transpose() +
                           measurement.new_content_share * measurement.blend_cov;
  EXPECT_LT((estimate.cov.block<6, 6>(kMapPose, kMapPose) - expected).norm(), 1e-15);
  const auto cross = estimate.cov.block<15, 6>(0, kMapPose);
  EXPECT_LT((cross - before.cov.block<15, 6>(0, kMapPose) * keep.transpose()).norm(), 1e-15);
  const Eigen::Matrix<double, 15, 15> rest = estimate.cov.topLeftCorner<15, 15>();
  EXPECT_EQ(rest, (before.cov.topLeftCorner<15, 15>()));
  EXPECT_EQ(BoxMinus(estimate.state, before.state).norm(), 0.0);
}

TEST(PoseUpdate, BlendShrinksTheMapPoseErrorByTheShareOfNewContent) {
  PoseMeasurement measurement;
  measurement.new_content_share = 0.25;
  measurement.blend_cov = 1e-4 * Matrix6::Identity();
  ExpectBlendKeeps(0.75 * Matrix6::Identity(), measurement);
}

TEST(PoseUpdate, AShareByDirectionShrinksTheErrorAlongItAlone) {
  PoseMeasurement measurement;
  measurement.new_content_share = 0.25;
  measurement.blend_cov = 1e-4 * Matrix6::Identity();
  measurement.knows_directions = true;
  measurement.share_by_direction(1, 1) = 0.9;
  Matrix6 keep = Matrix6::Identity();
  keep(1, 1) = 0.1;
  ExpectBlendKeeps(keep, measurement);
}

TEST(PoseUpdate, AMatchWithoutTheLastScanTellsSoMuchLess) {
  std::mt19937_64 random(13);
  const Matrix6 cov = test::RandomCovariance<6>(random, 0.1);
  EXPECT_EQ(CovWithoutLastScan(cov, Matrix6::Zero()), cov);
  const Matrix6 four_times = CovWithoutLastScan(cov, 0.75 * Matrix6::Identity());
  EXPECT_LT((four_times - 4.0 * cov).norm(), 1e-12 * cov.norm());
  // Phi = H^-1 L with 0 <= L < H: nothing becomes better known, whatever the axes.
  for (int i = 0; i < 100; ++i) {
    const Matrix6 of_last = test::RandomCovariance<6>(random, 0.1);
    const Matrix6 all = of_last + test::RandomCovariance<6>(random, 0.1);
    const Matrix6 less = CovWithoutLastScan(cov, all.inverse() * of_last);
    EXPECT_LT((less - less.transpose()).norm(), 1e-12 * less.norm());
    const Eigen::SelfAdjointEigenSolver<Matrix6> added(less - cov);
    EXPECT_GT(added.eigenvalues().minCoeff(), -1e-9 * less.norm());
  }
}

TEST(PoseUpdate, WhollyNewMapForgetsTheMapPoseError) {
  std::mt19937_64 random(11);
  Estimate estimate = RandomEstimate(random, 0.1);
  PoseMeasurement measurement;
  measurement.new_content_share = 1.0;
  measurement.blend_cov = 1e-4 * Matrix6::Identity();
  BlendMapPose(estimate, measurement);
  EXPECT_EQ((estimate.cov.block<15, 6>(0, kMapPose).cwiseAbs().maxCoeff()), 0.0);
  EXPECT_LT((estimate.cov.block<6, 6>(kMapPose, kMapPose) - measurement.blend_cov).norm(), 1e-18);
}

TEST(PoseUpdate, WhereTheMapIsTheWorldAPoseMeasuresBoth) {
  std::mt19937_64 random(12);
  Estimate estimate = RandomEstimate(random, 0.01);
  test::MakeMapTheWorld(estimate);
  EXPECT_EQ(LogSe3(estimate.state.T_world_imu.Inverse() * estimate.state.T_map_imu).norm(), 0.0);
  Estimate expected = estimate;  // the textbook's update of the world pose alone
  const Vector6 shift = 1e-4 * test::RandomVector<6>(random);
  const Matrix6 R = test::RandomCovariance<6>(random, 0.01);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, kStateDim);
  H.block<3, 3>(0, kPos) = estimate.state.T_world_imu.rotation.conjugate().toRotationMatrix();
  H.block<3, 3>(3, kRot) = Matrix3::Identity();
  FuseLinear(expected, H, shift, R);

  PoseMeasurement measurement;
  measurement.T_map_imu = estimate.state.T_world_imu * ExpSe3(shift);
  measurement.cov = R;
  ASSERT_TRUE(FusePose(estimate, measurement, kNoGate).fused);
  EXPECT_LT(BoxMinus(estimate.state, expected.state).norm(), 1e-7);  // the shift's square
  EXPECT_LT((estimate.cov - expected.cov).norm(), 1e-3 * expected.cov.norm());
  const Pose apart = estimate.state.T_world_imu.Inverse() * estimate.state.T_map_imu;
  EXPECT_LT(LogSe3(apart).norm(), 1e-7);
}

TEST(PoseUpdate, LinearUpdateOfOneNumberIsTheTextbooks) {
  Estimate estimate;
  estimate.cov = 4.0 * ErrorMatrix::Identity();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(1, kStateDim);
  H(0, kVel) = 1.0;
  FuseLinear(estimate, H, Eigen::VectorXd::Constant(1, 5.0), Eigen::MatrixXd::Identity(1, 1));
  EXPECT_NEAR(estimate.state.v_world_imu.x(), 4.0, 1e-12);  // gain 4 / (4 + 1)
  EXPECT_NEAR(estimate.cov(kVel, kVel), 0.8, 1e-12);
  EXPECT_NEAR(estimate.cov(kVel + 1, kVel + 1), 4.0, 1e-12);
}

}  // namespace
}  // namespace lio
