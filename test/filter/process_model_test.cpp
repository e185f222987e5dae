// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/process_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/motion.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;
using test::kGravity;

struct StepCase {
  NavState before;
  ImuSample from, to;
};

// Returns a step of `dt_s` with rates of order one rad/s and the force of a braking, turning car.
StepCase RandomStep(std::mt19937_64& random, double dt_s) {
  StepCase step;
  step.before = test::RandomState(random);
  step.from.stamp = test::kEpoch;
  step.to.stamp = test::StampAt(dt_s);
  for (ImuSample* sample : {&step.from, &step.to}) {
    sample->w_imu_radps = test::RandomVector<3>(random);
    sample->f_imu_mps2 = 3.0 * test::RandomVector<3>(random) - kGravity;
  }
  return step;
}

ErrorMatrix NumericTransition(const StepCase& step) {
  const NavState after = PropagateState(step.before, step.from, step.to, kGravity);
  return test::NumericJacobian(
      [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
        const NavState moved = BoxPlus(step.before, ErrorVector(error));
        return BoxMinus(PropagateState(moved, step.from, step.to, kGravity), after);
      },
      ErrorVector::Zero(), 1e-5);
}

NavState StateAlong(const test::Motion& motion, double t_s) {
  const test::MotionState truth = test::StateOf(motion, t_s);
  NavState state;
  state.T_world_imu = state.T_map_imu = truth.T_world_imu;
  state.v_world_imu = truth.v_world_imu;
  return state;
}

// Returns the state after `seconds` of steps of `step_s` along a motion, from its true start.
NavState IntegrateMotion(const test::Motion& motion, double seconds, double step_s) {
  const std::vector<ImuSample> samples = test::ExactSamples(motion, 0.0, seconds, step_s);
  NavState state = StateAlong(motion, 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    state = PropagateState(state, samples[i - 1], samples[i], kGravity);
  }
  return state;
}

ProcessNoise TestNoise() {
  return {.gyro_density = 5e-3,
          .accel_density = 5e-2,
          .gyro_bias_walk_density = 1e-3,
          .accel_bias_walk_density = 1e-2};
}

// Returns the smallest eigenvalue of the correlation matrix, for which units and sizes do not
// matter.
double SmallestCorrelation(const ErrorMatrix& all) {
  const Eigen::MatrixXd cov = all.topLeftCorner<kMapStart, kMapStart>();
  const Eigen::VectorXd inverse_std = cov.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlations = inverse_std.asDiagonal() * cov * inverse_std.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlations).eigenvalues().minCoeff();
}

// Returns d(error at `to`) / d(error at `from`) as Propagate applies it to the covariance of one
// error at a time. A step turns by less than a quarter, so the diagonal is positive.
ErrorMatrix TransitionOf(const StepCase& step) {
  ErrorMatrix transition;
  for (int i = 0; i < kStateDim; ++i) {
    Estimate estimate;
    estimate.stamp = step.from.stamp;
    estimate.state = step.before;
    estimate.cov(i, i) = 1.0;
    Propagate(estimate, step.from, step.to, ProcessNoise{}, kGravity);
    transition.col(i) = estimate.cov.col(i) / std::sqrt(estimate.cov(i, i));
  }
  return transition;
}

TEST(ProcessModel, TransitionMatchesDifferencesInEveryRow) {
  std::mt19937_64 random(1);
  for (const double dt_s : {0.0025, 0.01, 0.1}) {
    for (int i = 0; i < 5; ++i) {
      const StepCase step = RandomStep(random, dt_s);
      const ErrorMatrix analytic = TransitionOf(step);
      const ErrorMatrix numeric = NumericTransition(step);
      // The derivative of the coning term by the gyro bias is left out: dt^2/12 |w1 - w0|, and the
      // force turned by it.
      const double left_out =
          dt_s * dt_s / 12.0 * (step.to.w_imu_radps - step.from.w_imu_radps).norm();
      const double tolerance = 1e-8 + left_out;
      for (int row = 0; row < kStateDim; ++row) {
        EXPECT_LT((analytic.row(row) - numeric.row(row)).cwiseAbs().maxCoeff(), tolerance)
            << "row " << row << ", step of " << dt_s << " s\nanalytic " << analytic.row(row)
            << "\nnumeric  " << numeric.row(row);
      }
    }
  }
}

TEST(ProcessModel, PropagateAppliesTheTransitionAndAddsNoise) {
  std::mt19937_64 random(2);
  const StepCase step = RandomStep(random, 0.01);
  Estimate estimate;
  estimate.stamp = step.from.stamp;
  estimate.state = step.before;
  estimate.cov = test::RandomCovariance<kStateDim>(random, 0.1);
  Estimate without_noise = estimate;
  Propagate(without_noise, step.from, step.to, ProcessNoise{}, kGravity);
  const NavState after = PropagateState(step.before, step.from, step.to, kGravity);
  const ErrorMatrix F = TransitionOf(step);
  EXPECT_LT((without_noise.cov - F * estimate.cov * F.transpose()).norm(), 1e-14);
  EXPECT_EQ(without_noise.stamp, step.to.stamp);
  EXPECT_LT(BoxMinus(without_noise.state, after).norm(), 1e-14);

  Estimate with_noise = estimate;
  Propagate(with_noise, step.from, step.to, TestNoise(), kGravity);
  const ErrorMatrix added = with_noise.cov - without_noise.cov;
  EXPECT_TRUE((added.diagonal().head<kMapStart>().array() > 0).all())
      << added.diagonal().transpose();
  EXPECT_TRUE(added.rightCols<kStateDim - kMapStart>().isZero(0.0)) << "the map's start stays";
}

// The noise that the sensor shows is per axis of the imu; it turns into world with it.
TEST(ProcessModel, NoiseThatTheSensorShowsCountsPerAxisAndAtLeastAsTheRigSays) {
  std::mt19937_64 random(4);
  const StepCase step = RandomStep(random, 0.01);
  const ProcessNoise rig = TestNoise();
  const auto added_by = [&](const ProcessNoise& noise) {
    Estimate estimate;
    estimate.stamp = step.from.stamp;
    estimate.state = step.before;
    Estimate without = estimate;
    Propagate(estimate, step.from, step.to, noise, kGravity);
    Propagate(without, step.from, step.to, ProcessNoise{}, kGravity);
    return ErrorMatrix(estimate.cov - without.cov);
  };
  const ErrorMatrix by_rig = added_by(rig);

  ProcessNoise calmer = rig;
  calmer.shown.accel_psd = Vector3::Constant(0.5 * rig.accel_density * rig.accel_density);
  calmer.shown.gyro_psd = Vector3::Constant(0.5 * rig.gyro_density * rig.gyro_density);
  EXPECT_EQ(added_by(calmer), by_rig);

  ProcessNoise noise = rig;
  ImuNoise& shaken = noise.shown;
  shaken.accel_psd = Vector3(0.1, 0.4, 0.9);
  shaken.gyro_psd = Vector3(0.01, 0.02, 0.03);
  const ErrorMatrix by_sample = added_by(noise);
  const NavState after = PropagateState(step.before, step.from, step.to, kGravity);
  const Matrix3 R = after.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 velocity_cov = 0.01 * R * shaken.accel_psd.asDiagonal() * R.transpose();
  EXPECT_LT((by_sample.block<3, 3>(kVel, kVel) - velocity_cov).norm(), 1e-12);
  EXPECT_LT((by_sample.block<3, 3>(kPos, kPos) - 1e-4 / 3.0 * velocity_cov).norm(), 1e-12);
  EXPECT_LT((by_sample.block<3, 3>(kPos, kVel) - 0.005 * velocity_cov).norm(), 1e-12);
  const Vector3 turn_var = by_sample.block<3, 3>(kRot, kRot).diagonal();
  EXPECT_LT((turn_var - 0.01 * shaken.gyro_psd).norm(), 1e-12);
  // Both poses take the same increment: the map's errors are those of the world, seen from imu.
  const Matrix3 map_var = by_sample.block<3, 3>(kMapPose, kMapPose);
  EXPECT_LT((R * map_var * R.transpose() - by_sample.block<3, 3>(kPos, kPos)).norm(), 1e-12);
}

TEST(ProcessModel, PropagationConvergesWithOrderTwo) {
  const test::Motion motion = test::Tumble();
  const NavState truth = StateAlong(motion, 2.0);
  double coarser = 0;
  for (const double step_s : {0.04, 0.02, 0.01, 0.005}) {
    const NavState state = IntegrateMotion(motion, 2.0, step_s);
    const double error = BoxMinus(state, truth).head<9>().norm();
    if (coarser > 0) {
      const double order = std::log2(coarser / error);
      EXPECT_GT(order, 1.9) << "steps of " << step_s << " s, error " << error;
    }
    coarser = error;
  }
  EXPECT_LT(coarser, 1e-4);  // m, rad and m/s after two seconds of 200 Hz samples
}

TEST(ProcessModel, MapPoseMovesByTheSameIncrement) {
  const test::Motion motion = test::Tumble();
  NavState state = StateAlong(motion, 0.0);
  state.T_map_imu = ExpSe3(Vector6::Constant(0.7)) * state.T_world_imu;
  const std::vector<ImuSample> samples = test::ExactSamples(motion, 0.0, 1.0, 0.01);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    state = PropagateState(state, samples[i - 1], samples[i], kGravity);
  }
  const Pose T_map_world = state.T_map_imu * state.T_world_imu.Inverse();
  EXPECT_LT(LogSe3(T_map_world.Inverse() * ExpSe3(Vector6::Constant(0.7))).norm(), 1e-12);
}

TEST(ProcessModel, AtRestNothingMoves) {
  ImuSample from;
  from.stamp = test::kEpoch;
  from.f_imu_mps2 = -kGravity;
  ImuSample to = from;
  to.stamp = test::StampAt(0.01);
  const NavState after = PropagateState(NavState{}, from, to, kGravity);
  EXPECT_LT(BoxMinus(after, NavState{}).norm(), 1e-15);
}

TEST(ProcessModel, StepOfNoLengthChangesNothing) {
  std::mt19937_64 random(3);
  StepCase step = RandomStep(random, 0.0);
  Estimate estimate;
  estimate.stamp = step.from.stamp;
  estimate.state = step.before;
  estimate.cov = test::RandomCovariance<kStateDim>(random, 0.1);
  const Estimate before = estimate;
  Propagate(estimate, step.from, step.to, TestNoise(), kGravity);
  EXPECT_LT(BoxMinus(estimate.state, before.state).norm(), 1e-14);
  EXPECT_LT((estimate.cov - before.cov).norm(), 1e-14);
}

// Runs the same motion many times with noise drawn from the densities; the spread of the results
// has to be the covariance that the model predicts, cross terms included.
TEST(ProcessModel, NoiseTermsAgreeWithMonteCarlo) {
  constexpr int kRuns = 2000;
  constexpr double kStep_s = 0.02;
  const test::Motion motion = test::Tumble();
  const std::vector<ImuSample> samples = test::ExactSamples(motion, 0.0, 1.0, kStep_s);
  const ProcessNoise noise = TestNoise();

  Estimate predicted;
  predicted.stamp = samples.front().stamp;
  predicted.state = StateAlong(motion, 0.0);
  const NavState start = predicted.state;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    Propagate(predicted, samples[i - 1], samples[i], noise, kGravity);
  }

  std::mt19937_64 random(4);
  const double white = 1.0 / std::sqrt(kStep_s);
  const double walk = std::sqrt(kStep_s);
  ErrorMatrix spread = ErrorMatrix::Zero();
  for (int run = 0; run < kRuns; ++run) {
    NavState state = start;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      // White noise is held over the step: it is the same at both ends.
      const Vector3 w_noise = noise.gyro_density * white * test::RandomVector<3>(random);
      const Vector3 f_noise = noise.accel_density * white * test::RandomVector<3>(random);
      ImuSample from = samples[i - 1];
      ImuSample to = samples[i];
      for (ImuSample* sample : {&from, &to}) {
        sample->w_imu_radps += w_noise;
        sample->f_imu_mps2 += f_noise;
      }
      state = PropagateState(state, from, to, kGravity);
      state.gyro_bias += noise.gyro_bias_walk_density * walk * test::RandomVector<3>(random);
      state.accel_bias += noise.accel_bias_walk_density * walk * test::RandomVector<3>(random);
    }
    const ErrorVector error = BoxMinus(state, predicted.state);
    spread += error * error.transpose() / kRuns;
  }
  // In coordinates where the prediction is the identity the spread is, too, to 4.5 standard
  // deviations of a sample covariance: 1/sqrt(runs) off the diagonal, sqrt(2/runs) on it. The map
  // pose repeats the world pose's noise here, so its rows are checked against the prediction.
  const Eigen::Matrix<double, 15, 15> cov = predicted.cov.topLeftCorner<15, 15>();
  const Eigen::LLT<Eigen::Matrix<double, 15, 15>> root(cov);
  ASSERT_EQ(root.info(), Eigen::Success);
  const Eigen::Matrix<double, 15, 15> half = root.matrixL().solve(spread.topLeftCorner<15, 15>());
  const Eigen::Matrix<double, 15, 15> whitened = root.matrixL().solve(half.transpose());
  const Eigen::Matrix<double, 15, 15> off = whitened - Eigen::Matrix<double, 15, 15>::Identity();
  EXPECT_LT(off.diagonal().cwiseAbs().maxCoeff(), 4.5 * std::sqrt(2.0 / kRuns)) << whitened;
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 4.5 * std::sqrt(2.0 / kRuns)) << whitened;
  for (int i = kMapPose; i < kMapStart; ++i) {
    EXPECT_NEAR(spread(i, i) / predicted.cov(i, i), 1.0, 4.5 * std::sqrt(2.0 / kRuns)) << i;
    for (int j = 0; j < i; ++j) {
      const double scale = std::sqrt(predicted.cov(i, i) * predicted.cov(j, j));
      EXPECT_NEAR(spread(i, j) / scale, predicted.cov(i, j) / scale, 4.5 * std::sqrt(2.0 / kRuns))
          << i << ", " << j;
    }
  }
}

TEST(ProcessModel, WhiteForceNoiseHasThePositionVelocityCrossTerms) {
  const ImuSample from{test::kEpoch, Vector3::Zero(), -kGravity};
  const ImuSample to{test::StampAt(0.1), Vector3::Zero(), -kGravity};
  Estimate estimate;
  estimate.stamp = from.stamp;
  Propagate(estimate, from, to, ProcessNoise{.accel_density = 0.2}, kGravity);
  EXPECT_NEAR(estimate.cov(kVel, kVel), 0.04 * 0.1, 1e-15);
  EXPECT_NEAR(estimate.cov(kPos, kVel), 0.04 * 0.01 / 2, 1e-15);
  EXPECT_NEAR(estimate.cov(kPos, kPos), 0.04 * 0.001 / 3, 1e-15);
}

TEST(ProcessModel, CovarianceStaysSymmetricAndPositiveOverALongRun) {
  const test::Motion motion = test::Tumble();
  const std::vector<ImuSample> samples = test::ExactSamples(motion, 0.0, 10.0, 0.01);
  std::mt19937_64 random(5);
  Estimate estimate;
  estimate.stamp = samples.front().stamp;
  estimate.state = StateAlong(motion, 0.0);
  estimate.cov = 1e-6 * ErrorMatrix::Identity();
  Timestamp stamp = samples.front().stamp;
  for (int lap = 0; lap < 20; ++lap) {  // 200 s
    for (std::size_t i = 1; i < samples.size(); ++i) {
      ImuSample from = samples[i - 1];
      ImuSample to = samples[i];
      from.stamp = stamp;
      stamp = to.stamp = stamp + Duration::FromSeconds(0.01);
      Propagate(estimate, from, to, TestNoise(), kGravity);
    }
  }
  EXPECT_EQ((estimate.cov - estimate.cov.transpose()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(SmallestCorrelation(estimate.cov),
            -1e-12);  // T and M become one: zero but for rounding
}

TEST(ProcessModel, SamplesBetweenTwoAreLinear) {
  ImuSample a{test::StampAt(0.0), Vector3(1, 2, 3), Vector3(4, 5, 6)};
  ImuSample b{test::StampAt(0.02), Vector3(3, 2, 1), Vector3(0, 5, 8)};
  const ImuSample middle = InterpolateSample(a, b, test::StampAt(0.005));
  EXPECT_EQ(middle.stamp, test::StampAt(0.005));
  EXPECT_LT((middle.w_imu_radps - Vector3(1.5, 2, 2.5)).norm(), 1e-12);
  EXPECT_LT((middle.f_imu_mps2 - Vector3(3, 5, 6.5)).norm(), 1e-12);
}

TEST(ProcessModel, SamplesBeyondBothEndsAreHeld) {
  ImuSample a{test::StampAt(0.0), Vector3(1, 2, 3), Vector3(4, 5, 6)};
  ImuSample b{test::StampAt(0.02), Vector3(3, 2, 1), Vector3(0, 5, 8)};
  EXPECT_EQ(InterpolateSample(a, b, test::StampAt(-1.0)).w_imu_radps, a.w_imu_radps);
  EXPECT_EQ(InterpolateSample(a, b, test::StampAt(1.0)).w_imu_radps, b.w_imu_radps);
  EXPECT_EQ(InterpolateSample(a, a, test::StampAt(0.5)).f_imu_mps2, a.f_imu_mps2);
}

}  // namespace
}  // namespace lio
