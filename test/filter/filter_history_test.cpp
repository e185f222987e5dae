// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/filter_history.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <random>

#include "filter/tumbling_filter.hpp"
#include "lio/filter/map_bend.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::AddImuUpTo;
using test::BoxMinus;
using test::Difference;
using test::PoseAt;
using test::SampleAt;
using test::StampAt;
using test::StartedHistory;
using test::StartEstimate;
using test::TestMotion;
using test::TestOptions;

TEST(FilterHistory, LateMeasurementEqualsInOrder) {
  FilterHistory in_order = StartedHistory();
  AddImuUpTo(in_order, 0.5);
  EXPECT_EQ(in_order.AddPose(StampAt(0.5), PoseAt(0.5, Vector6::Constant(0.01))),
            EventOutcome::kApplied);
  AddImuUpTo(in_order, 1.0);
  FilterHistory late = StartedHistory();
  AddImuUpTo(late, 1.0);
  UpdateResult update;
  EXPECT_EQ(late.AddPose(StampAt(0.5), PoseAt(0.5, Vector6::Constant(0.01)), &update),
            EventOutcome::kApplied);
  EXPECT_TRUE(update.fused);
  EXPECT_GT(update.nis, 0.0);
  EXPECT_LT(Difference(late.head(), in_order.head()), 1e-9);
}

TEST(FilterHistory, EventsBeforeTheStartAreRefused) {
  FilterHistory history = StartedHistory();
  const Estimate before = history.head();
  EXPECT_EQ(history.AddImu(SampleAt(-0.01)), EventOutcome::kBeforeStart);
  EXPECT_EQ(history.AddPose(StampAt(-0.01), PoseAt(0)), EventOutcome::kBeforeStart);
  EXPECT_EQ(history.AddRebase(StampAt(-0.01)), EventOutcome::kBeforeStart);
  EXPECT_EQ(Difference(history.head(), before), 0.0);
}

TEST(FilterHistory, EventsBeforeTheWindowAreTooOld) {
  HistoryOptions options = TestOptions();
  options.span_s = 0.5;
  FilterHistory history = StartedHistory(options);
  AddImuUpTo(history, 2.0);
  const Estimate before = history.head();
  EXPECT_EQ(history.AddPose(StampAt(1.4), PoseAt(1.4)), EventOutcome::kTooOld);
  EXPECT_EQ(history.AddImu(SampleAt(1.41)), EventOutcome::kTooOld);
  EXPECT_EQ(history.AddRebase(StampAt(0.3)), EventOutcome::kTooOld);
  EXPECT_EQ(Difference(history.head(), before), 0.0);
  EXPECT_EQ(history.AddPose(StampAt(1.6), PoseAt(1.6)), EventOutcome::kApplied);
}

TEST(FilterHistory, SecondEventOfAKindAtAStampIsADuplicate) {
  FilterHistory history = StartedHistory();
  EXPECT_EQ(history.AddImu(SampleAt(0.0)), EventOutcome::kDuplicate);
  AddImuUpTo(history, 0.2);
  EXPECT_EQ(history.AddPose(StampAt(0.1), PoseAt(0.1)), EventOutcome::kApplied);
  EXPECT_EQ(history.AddRebase(StampAt(0.1)), EventOutcome::kApplied);
  const Estimate before = history.head();
  EXPECT_EQ(history.AddImu(SampleAt(0.1)), EventOutcome::kDuplicate);
  EXPECT_EQ(history.AddPose(StampAt(0.1), PoseAt(0.1)), EventOutcome::kDuplicate);
  EXPECT_EQ(history.AddRebase(StampAt(0.1)), EventOutcome::kDuplicate);
  EXPECT_EQ(Difference(history.head(), before), 0.0);
}

TEST(FilterHistory, PoseTooFarOffIsGatedAndChangesNothing) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  const Estimate before = history.head();
  UpdateResult update;
  EXPECT_EQ(history.AddPose(StampAt(0.4), PoseAt(0.4, 3.0 * Vector6::Unit(0)), &update),
            EventOutcome::kGated);
  EXPECT_FALSE(update.fused);
  EXPECT_GT(update.nis, TestOptions().nis_limit);
  // The results agree to rounding: the step over the pose is done in two.
  EXPECT_LT(BoxMinus(history.head().state, before.state).norm(), 1e-5);
}

TEST(FilterHistory, ForcedPoseIsFusedWithTheCovarianceInflated) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  const Estimate before = history.head();
  PoseEvent event = PoseAt(0.5, 3.0 * Vector6::Unit(0));
  event.force = true;
  EXPECT_EQ(history.AddPose(StampAt(0.5), event), EventOutcome::kApplied);
  const double off_before =
      LogSe3(event.measurement.T_map_imu.Inverse() * before.state.T_map_imu).norm();
  const double off_after =
      LogSe3(event.measurement.T_map_imu.Inverse() * history.head().state.T_map_imu).norm();
  EXPECT_LT(off_after, 0.3 * off_before);
  EXPECT_GT(history.head().cov(kVel, kVel), before.cov(kVel, kVel));
}

// No time has passed according to the stamps: the position becomes uncertain, the speed is as
// before.
TEST(FilterHistory, ASetClockTakesTheWayBackAndLeavesTheSpeed) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  EXPECT_EQ(history.AddImu(SampleAt(2.0)),
            EventOutcome::kApplied);  // place and speed of the gap are correlated
  const Estimate before = history.head();
  PoseEvent event;
  event.measurement.T_map_imu = before.state.T_map_imu * ExpSe3(-16.0 * Vector6::Unit(0));
  event.measurement.cov = 1e-4 * Matrix6::Identity();
  event.motion = PredictedMotion::kTakenBack;
  EXPECT_EQ(history.AddPose(StampAt(2.0), event), EventOutcome::kApplied);
  const NavState& state = history.head().state;
  EXPECT_LT(LogSe3(event.measurement.T_map_imu.Inverse() * state.T_map_imu).norm(), 0.01);
  EXPECT_LT((state.v_world_imu - before.state.v_world_imu).norm(), 1.5);
}

TEST(FilterHistory, RebaseMakesTheMapPoseErrorZero) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  const Estimate before = history.At(StampAt(0.3));
  ASSERT_GT(before.cov(kMapPose, kMapPose), 0.0);
  EXPECT_EQ(history.AddRebase(StampAt(0.3)), EventOutcome::kApplied);
  const Estimate after = history.At(StampAt(0.3));
  EXPECT_EQ(after.cov.middleRows<6>(kMapPose).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(after.cov.middleCols<6>(kMapPose).cwiseAbs().maxCoeff(), 0.0);
  const double change = (after.cov - before.cov).topLeftCorner(15, 15).cwiseAbs().maxCoeff();
  EXPECT_LT(change, 1e-15);
}

// A new map has not bent yet, whatever the one before had, and its start is as unsure as the state.
TEST(FilterHistory, RebaseMarksTheStartOfTheMap) {
  Estimate bent = StartEstimate();
  bent.state.T_world_imu.rotation =
      (bent.state.T_world_imu.rotation * ExpSo3(Vector3(0.05, -0.03, 0.0))).normalized();
  ASSERT_GT(MapBend(bent.state).norm(), 0.05);
  FilterHistory history(TestOptions(), bent, SampleAt(0.0));
  AddImuUpTo(history, 0.5);
  EXPECT_EQ(history.AddRebase(StampAt(0.3)), EventOutcome::kApplied);
  const Estimate after = history.At(StampAt(0.3));
  EXPECT_LT(MapBend(after.state).norm(), 1e-12);
  const Matrix3 R_world_imu = after.state.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 rotation_cov =
      R_world_imu * after.cov.block<3, 3>(kRot, kRot) * R_world_imu.transpose();
  EXPECT_LT((after.cov.block<3, 3>(kMapStart, kMapStart) - rotation_cov).cwiseAbs().maxCoeff(),
            1e-15);
}

TEST(FilterHistory, StandstillBringsTheVelocityToZeroAsFarAsItIsSure) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  const Estimate before = history.head();
  EXPECT_EQ(history.AddZeroVelocity(StampAt(0.5), 1e6), EventOutcome::kApplied);
  EXPECT_LT(Difference(history.head(), before), 1e-5) << "worth nothing";
  EXPECT_EQ(history.AddZeroVelocity(StampAt(0.5), 4.0), EventOutcome::kDuplicate);
  EXPECT_EQ(history.AddZeroVelocity(StampAt(0.4), 1e-4), EventOutcome::kGated)
      << "at " << before.state.v_world_imu.norm() << " m/s";
  EXPECT_EQ(history.AddZeroVelocity(StampAt(-0.1), 1e-4), EventOutcome::kBeforeStart);
}

TEST(FilterHistory, SamplesBetweenAreTheMeasuredOnes) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.2);
  EXPECT_EQ(history.AddPose(StampAt(0.11), PoseAt(0.11)), EventOutcome::kApplied);
  const std::vector<ImuSample> samples = history.SamplesBetween(StampAt(0.1), StampAt(0.16));
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples.front().stamp, StampAt(0.12));
  EXPECT_EQ(samples.back().stamp, StampAt(0.16));
}

TEST(FilterHistory, TrimmingDoesNotChangeTheHead) {
  HistoryOptions options = TestOptions();
  options.span_s = 0.3;
  FilterHistory trimmed = StartedHistory(options);
  FilterHistory whole = StartedHistory();
  for (FilterHistory* history : {&trimmed, &whole}) {
    for (int i = 1; i <= 20; ++i) {
      AddImuUpTo(*history, 0.1 * i);
      EXPECT_EQ(history->AddPose(StampAt(0.1 * i - 0.05), PoseAt(0.1 * i - 0.05)),
                EventOutcome::kApplied);
    }
  }
  EXPECT_EQ(Difference(trimmed.head(), whole.head()), 0.0);
}

// Once the sample at the window's first stamp is forgotten, nothing may be put before what is
// left of that stamp.
TEST(FilterHistory, NothingIsInsertedBeforeTheFirstEventOfTheWindow) {
  HistoryOptions options = TestOptions();
  options.span_s = 0.5;
  FilterHistory history = StartedHistory(options);
  AddImuUpTo(history, 1.0);
  EXPECT_EQ(history.AddPose(StampAt(0.6), PoseAt(0.6)), EventOutcome::kApplied);
  EXPECT_EQ(history.AddRebase(StampAt(0.6)), EventOutcome::kApplied);
  AddImuUpTo(history, 1.1);  // the window begins with the rebase at 0.6 s
  const Estimate before = history.head();
  EXPECT_EQ(history.AddPose(StampAt(0.6), PoseAt(0.6)), EventOutcome::kTooOld);
  EXPECT_EQ(history.AddImu(SampleAt(0.6)), EventOutcome::kTooOld);
  EXPECT_EQ(Difference(history.head(), before), 0.0);
}

TEST(FilterHistory, EstimateBetweenEventsIsPropagated) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 1.0);
  const Estimate at = history.At(StampAt(0.503));
  EXPECT_EQ(at.stamp, StampAt(0.503));
  EXPECT_LT(LogSe3(TestMotion()(0.503).Inverse() * at.state.T_world_imu).norm(), 1e-3);
  EXPECT_GT(at.cov(kPos, kPos), history.At(StampAt(0.5)).cov(kPos, kPos));
  EXPECT_LT(at.cov(kPos, kPos), history.At(StampAt(0.52)).cov(kPos, kPos));
}

TEST(FilterHistory, EstimateBeyondTheHeadHoldsTheLastSample) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 1.0);
  const Estimate at = history.At(StampAt(1.02));
  EXPECT_LT(LogSe3(TestMotion()(1.02).Inverse() * at.state.T_world_imu).norm(), 2e-3);
}

TEST(FilterHistory, EstimateBeforeTheWindowIsTheOldestOne) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.5);
  EXPECT_EQ(Difference(history.At(StampAt(-5.0)), StartEstimate()), 0.0);
}

TEST(FilterHistory, TrajectoryHasItsEndsAndEveryEventBetween) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 1.0);
  EXPECT_EQ(history.AddPose(StampAt(0.51), PoseAt(0.51)), EventOutcome::kApplied);
  EXPECT_EQ(history.AddPose(StampAt(0.54), PoseAt(0.54)),
            EventOutcome::kApplied);  // at a sample's stamp: one entry
  const StampedPoses poses = history.Trajectory(StampAt(0.5), StampAt(0.595));
  std::vector<double> stamps_s;
  for (const StampedPose& pose : poses) stamps_s.push_back(test::SecondsOf(pose.stamp));
  const std::vector<double> expected = {0.5, 0.51, 0.52, 0.54, 0.56, 0.58, 0.595};
  ASSERT_EQ(stamps_s.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(stamps_s[i], expected[i], 1e-9);
    const Pose& pose = history.At(poses[i].stamp).state.T_world_imu;
    EXPECT_LT(LogSe3(pose.Inverse() * poses[i].pose).norm(), 1e-12) << i;
  }
}

TEST(FilterHistory, TrajectoryOfNoLengthIsOnePose) {
  FilterHistory history = StartedHistory();
  AddImuUpTo(history, 0.2);
  EXPECT_EQ(history.Trajectory(StampAt(0.1), StampAt(0.1)).size(), 1u);
}

TEST(FilterHistory, SaturationWidensTheCovarianceOfItsSensorOnly) {
  const auto after = [](bool rate, bool force) {
    FilterHistory history = StartedHistory();
    for (int k = 1; k <= 10; ++k) {
      ImuSample sample = SampleAt(0.01 * k);
      sample.is_rate_saturated = rate;
      sample.is_force_saturated = force;
      EXPECT_EQ(history.AddImu(sample), EventOutcome::kApplied);
    }
    return history.head().cov;
  };
  const HistoryOptions options;
  const ErrorMatrix clean = after(false, false);
  const ErrorMatrix no_rate = after(true, false);
  const ErrorMatrix no_force = after(false, true);
  // The noise of a saturated interval is that of a constant error over saturated_s.
  const ImuOutageParameters& outage = options.imu_outage;
  const double turn_std_rad = outage.saturated_s * outage.saturated_gyro_std_radps;
  const double speed_std_mps = outage.saturated_s * outage.saturated_accel_std_mps2;
  EXPECT_NEAR(std::sqrt(no_rate(kRot, kRot) - clean(kRot, kRot)), turn_std_rad,
              0.01 * turn_std_rad);
  EXPECT_NEAR(std::sqrt(no_force(kVel, kVel) - clean(kVel, kVel)), speed_std_mps,
              0.01 * speed_std_mps);
  EXPECT_DOUBLE_EQ(no_force(kRot, kRot), clean(kRot, kRot));
}

// A gyro that reads one per cent too much of a rate that goes to and fro, so that it is no bias, is
// off by up to 4 mrad a scan, where matches are right to 0.2 mrad: all poses but some would be
// refused without its being learned.
TEST(FilterHistory, PosesAreFusedThoughTheGyrosScaleIsWrong) {
  constexpr double kPeakRate_radps = 4.0;
  constexpr double kFrequency_radps = 2.0;
  HistoryOptions options = TestOptions();
  options.noise.gyro_density = 5e-4;
  const auto sample_at = [&](double t_s) {
    ImuSample sample;
    sample.stamp = StampAt(t_s);
    sample.w_imu_radps = Vector3(0, 0, 1.01 * kPeakRate_radps * std::sin(kFrequency_radps * t_s));
    sample.f_imu_mps2 = -options.g_world;
    return sample;
  };
  Estimate start = StartEstimate();
  start.state = NavState{};
  FilterHistory history(options, start, sample_at(0.0));
  int num_refused_late = 0;
  for (int k = 1; k <= 600; ++k) {
    EXPECT_EQ(history.AddImu(sample_at(0.01 * k)), EventOutcome::kApplied);
    if (k % 10 != 0) continue;
    PoseEvent event;
    const double yaw_rad =
        kPeakRate_radps / kFrequency_radps * (1.0 - std::cos(kFrequency_radps * 0.01 * k));
    event.measurement.T_map_imu.rotation = ExpSo3(Vector3(0, 0, yaw_rad));
    event.measurement.cov = 4e-8 * Matrix6::Identity();
    event.force = k % 50 == 0;
    const bool is_fused = history.AddPose(StampAt(0.01 * k), event) == EventOutcome::kApplied;
    if (k > 100 && !is_fused) ++num_refused_late;
  }
  EXPECT_EQ(num_refused_late, 0);
  EXPECT_GT(history.RateErrorStd(StampAt(5.5)), 2e-3 * kPeakRate_radps);  // sin(11) is -1
}

// Noise counts from its own stamp on, whether it was known then or later.
TEST(FilterHistory, NoiseThatTheSensorShowsCountsFromItsStampOn) {
  const ImuNoise shaken{Vector3::Constant(0.01), Vector3(1.0, 2.0, 3.0)};
  FilterHistory plain = StartedHistory();
  AddImuUpTo(plain, 1.0);
  FilterHistory in_order = StartedHistory();
  AddImuUpTo(in_order, 0.5);
  EXPECT_EQ(in_order.AddNoise(StampAt(0.5), shaken), EventOutcome::kApplied);
  AddImuUpTo(in_order, 1.0);
  FilterHistory late = StartedHistory();
  AddImuUpTo(late, 1.0);
  EXPECT_EQ(late.AddNoise(StampAt(0.5), shaken), EventOutcome::kApplied);

  EXPECT_LT((late.head().cov - in_order.head().cov).norm(), 1e-9);
  EXPECT_LT((late.At(StampAt(0.5)).cov - plain.At(StampAt(0.5)).cov).norm(), 1e-9);
  const ErrorMatrix added = late.head().cov - plain.head().cov;
  EXPECT_NEAR((added.block<3, 3>(kRot, kRot).trace()), 3 * 0.5 * 0.01, 0.05 * 3 * 0.5 * 0.01);
  EXPECT_GT((added.block<3, 3>(kVel, kVel).trace()), 0.9 * 0.5 * 6.0);
  EXPECT_EQ(late.AddNoise(StampAt(0.5), shaken), EventOutcome::kDuplicate);
  EXPECT_EQ(late.AddNoise(StampAt(-0.1), shaken), EventOutcome::kBeforeStart);
}

TEST(FilterHistory, CovarianceStaysPositiveOverALongRun) {
  FilterHistory history = StartedHistory();
  std::mt19937_64 random(7);
  for (int i = 1; i <= 300; ++i) {
    AddImuUpTo(history, 0.1 * i);
    PoseEvent event = PoseAt(0.1 * i, 0.02 * test::RandomVector<6>(random));
    event.measurement.new_content_share = 0.1;
    event.measurement.blend_cov = 1e-4 * Matrix6::Identity();
    EXPECT_EQ(history.AddPose(StampAt(0.1 * i), event), EventOutcome::kApplied);
    const ErrorMatrix& cov = history.head().cov;
    ASSERT_EQ((cov - cov.transpose()).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::MatrixXd moving = cov.topLeftCorner<kMapStart, kMapStart>();
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(moving).eigenvalues().minCoeff(), 0.0)
        << i;
  }
}

}  // namespace
}  // namespace lio
