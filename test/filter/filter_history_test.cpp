// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/filter_history.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>

#include "support/motion.hpp"
#include "support/property.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr double kImuStep_s = 0.02;

HistoryOptions TestOptions() {
  HistoryOptions options;
  options.noise = {.gyro_density = 2e-3,
                   .accel_density = 2e-2,
                   .gyro_bias_walk_density = 1e-4,
                   .accel_bias_walk_density = 1e-3};
  options.g_world = test::kGravity;
  return options;
}

const test::Motion& TestMotion() {
  static const test::Motion kMotion = test::Tumble();
  return kMotion;
}

Estimate StartEstimate() {
  const test::MotionState truth = test::StateOf(TestMotion(), 0.0);
  Estimate estimate;
  estimate.stamp = StampAt(0.0);
  estimate.state.T_world_imu = estimate.state.T_map_imu = truth.T_world_imu;
  estimate.state.v_world_imu = truth.v_world_imu;
  ErrorVector std;
  std << Vector3::Constant(0.01), Vector3::Constant(0.01), Vector3::Constant(0.1),
      Vector3::Constant(5e-3), Vector3::Constant(0.05), Vector6::Zero();
  estimate.cov = std.cwiseAbs2().asDiagonal();
  return estimate;
}

ImuSample SampleAt(double t_s) {
  return test::ExactSample(TestMotion(), t_s);
}

FilterHistory StartedHistory(const HistoryOptions& options = TestOptions()) {
  return {options, StartEstimate(), SampleAt(0.0)};
}

PoseEvent PoseAt(double t_s, const Vector6& error = Vector6::Zero(), double std = 0.02) {
  PoseEvent event;
  event.measurement.T_map_imu = TestMotion()(t_s) * ExpSe3(error);
  event.measurement.cov = std * std * Matrix6::Identity();
  return event;
}

void AddImuUpTo(FilterHistory& history, double to_s, double step_s = kImuStep_s) {
  const double from_s = test::SecondsOf(history.head().stamp);
  const auto num_steps = static_cast<int>(std::lround((to_s - from_s) / step_s));
  for (int i = 1; i <= num_steps; ++i) history.AddImu(SampleAt(from_s + i * step_s));
}

double Difference(const Estimate& a, const Estimate& b) {
  return std::max(BoxMinus(a.state, b.state).cwiseAbs().maxCoeff(),
                  (a.cov - b.cov).cwiseAbs().maxCoeff());
}

enum class Kind { kImu, kPose, kRebase };
struct Event {
  Kind kind = Kind::kImu;
  double t_s = 0;
  PoseEvent pose;  // for poses
};

EventOutcome Feed(FilterHistory& history, const Event& event) {
  switch (event.kind) {
    case Kind::kImu:
      return history.AddImu(SampleAt(event.t_s));
    case Kind::kPose:
      return history.AddPose(StampAt(event.t_s), event.pose);
    case Kind::kRebase:
      break;
  }
  return history.AddRebase(StampAt(event.t_s));
}

// A second and a half of samples, some lost; poses, one in eight far off, and rebases among them,
// at stamps of their own or at a sample's. In order.
std::vector<Event> RandomEvents() {
  std::vector<Event> events;
  for (int i = 1; i <= 75; ++i) {
    const bool is_lost = *rc::gen::inRange(0, 10) == 9;
    if (!is_lost) events.push_back({Kind::kImu, i * kImuStep_s, {}});
  }
  const auto pose_stamps_ms = *rc::gen::unique<std::vector<int>>(rc::gen::inRange(1, 1501));
  for (const int stamp_ms : pose_stamps_ms) {
    const double t_s = 1e-3 * stamp_ms;
    std::mt19937_64 random(static_cast<unsigned>(stamp_ms));
    const double size = *rc::gen::inRange(0, 8) == 0 ? 2.0 : 0.01;
    PoseEvent event = PoseAt(t_s, size * test::RandomVector<6>(random));
    event.force = *rc::gen::arbitrary<bool>();
    event.measurement.new_content_share = 0.1;
    event.measurement.blend_cov = 1e-4 * Matrix6::Identity();
    events.push_back({Kind::kPose, t_s, event});
    if (*rc::gen::inRange(0, 6) == 0) events.push_back({Kind::kRebase, t_s, {}});
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return StampAt(a.t_s) != StampAt(b.t_s) ? a.t_s < b.t_s : a.kind < b.kind;
  });
  return events;
}

// The same events as they come in when each is delayed by up to a second.
std::vector<Event> Delayed(const std::vector<Event>& events) {
  const std::vector<int> delays_ms =
      *rc::gen::container<std::vector<int>>(events.size(), rc::gen::inRange(0, 1001));
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return events[a].t_s + 1e-3 * delays_ms[a] < events[b].t_s + 1e-3 * delays_ms[b];
  });
  std::vector<Event> delayed;
  for (const std::size_t i : order) delayed.push_back(events[i]);
  return delayed;
}

TEST(FilterHistory, AnyOrderOfArrivalGivesThePosteriorOfTheRightOne) {
  test::CheckProperty([] {
    const std::vector<Event> events = RandomEvents();
    FilterHistory in_order = StartedHistory();
    for (const Event& event : events) Feed(in_order, event);
    FilterHistory as_arrived = StartedHistory();
    for (const Event& event : Delayed(events)) Feed(as_arrived, event);
    RC_ASSERT(as_arrived.head().stamp == in_order.head().stamp);
    RC_ASSERT(Difference(as_arrived.head(), in_order.head()) < 1e-9);
    const Timestamp between = StampAt(1e-3 * *rc::gen::inRange(0, 1600));
    RC_ASSERT(Difference(as_arrived.At(between), in_order.At(between)) < 1e-9);
  });
}

TEST(FilterHistory, LateMeasurementEqualsInOrder) {
  FilterHistory in_order = StartedHistory();
  AddImuUpTo(in_order, 0.5);
  in_order.AddPose(StampAt(0.5), PoseAt(0.5, Vector6::Constant(0.01)));
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
  // To rounding: the step over the pose is done in two.
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

TEST(FilterHistory, TrimmingDoesNotChangeTheHead) {
  HistoryOptions options = TestOptions();
  options.span_s = 0.3;
  FilterHistory trimmed = StartedHistory(options);
  FilterHistory whole = StartedHistory();
  for (FilterHistory* history : {&trimmed, &whole}) {
    for (int i = 1; i <= 20; ++i) {
      AddImuUpTo(*history, 0.1 * i);
      history->AddPose(StampAt(0.1 * i - 0.05), PoseAt(0.1 * i - 0.05));
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
  history.AddPose(StampAt(0.6), PoseAt(0.6));
  history.AddRebase(StampAt(0.6));
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
  history.AddPose(StampAt(0.51), PoseAt(0.51));
  history.AddPose(StampAt(0.54), PoseAt(0.54));  // at a sample's stamp: one entry
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

TEST(FilterHistory, GapInTheSamplesWidensTheCovariance) {
  FilterHistory with_gap = StartedHistory();
  FilterHistory without = StartedHistory();
  AddImuUpTo(without, 0.6);
  with_gap.AddImu(SampleAt(0.6));
  EXPECT_GT(with_gap.head().cov(kVel, kVel), 10 * without.head().cov(kVel, kVel));
  EXPECT_GT(with_gap.head().cov(kRot, kRot), 10 * without.head().cov(kRot, kRot));
}

// A scan in the middle of a gap makes two short steps of a long one: it stays a gap.
TEST(FilterHistory, GapIsAGapWithAPoseInIt) {
  FilterHistory plain = StartedHistory();
  FilterHistory split = StartedHistory();
  plain.AddImu(SampleAt(0.04));
  split.AddImu(SampleAt(0.04));
  const PoseEvent worthless = PoseAt(0.02, Vector6::Zero(), 1e6);
  EXPECT_EQ(split.AddPose(StampAt(0.02), worthless), EventOutcome::kApplied);
  for (const int at : {kPos, kRot, kVel, kMapPose, kMapPose + 3}) {
    const double start = StartEstimate().cov(at, at);
    const double grown = split.head().cov(at, at) - start;
    // What an interval is unsure of lasts for that interval, so two halves add up to half of it.
    EXPECT_GT(grown, 0.45 * (plain.head().cov(at, at) - start)) << at;
  }
}

TEST(FilterHistory, CovarianceStaysPositiveOverALongRun) {
  FilterHistory history = StartedHistory();
  std::mt19937_64 random(7);
  for (int i = 1; i <= 300; ++i) {
    AddImuUpTo(history, 0.1 * i);
    PoseEvent event = PoseAt(0.1 * i, 0.02 * test::RandomVector<6>(random));
    event.measurement.new_content_share = 0.1;
    event.measurement.blend_cov = 1e-4 * Matrix6::Identity();
    history.AddPose(StampAt(0.1 * i), event);
    const ErrorMatrix& cov = history.head().cov;
    ASSERT_EQ((cov - cov.transpose()).cwiseAbs().maxCoeff(), 0.0);
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<ErrorMatrix>(cov).eigenvalues().minCoeff(), 0.0) << i;
  }
}

// --- consistency: noise as the filter assumes it, and a map that does not move

struct TruthRun {
  NavState truth;
  Estimate estimate;
};

// Ten seconds of noisy samples and of poses against a map fixed where the first scan put it.
TruthRun RunWithNoise(unsigned seed, double seconds) {
  constexpr double kPoseStd = 0.02;
  std::mt19937_64 random(seed);
  HistoryOptions options = TestOptions();
  options.nis_limit = std::numeric_limits<double>::infinity();
  const ProcessNoise& noise = options.noise;

  TruthRun run;
  Estimate start = StartEstimate();
  const ErrorVector start_error = test::DrawFrom(start.cov, random);
  NavState truth = start.state;
  start.state = BoxPlus(truth, start_error);
  start.state.T_map_imu = start.state.T_world_imu;
  const Pose T_map_world = start.state.T_map_imu * truth.T_world_imu.Inverse();

  const auto measured = [&](double t_s) {
    ImuSample sample = SampleAt(t_s);
    const double white = 1.0 / std::sqrt(kImuStep_s);
    sample.w_imu_radps +=
        truth.gyro_bias + noise.gyro_density * white * test::RandomVector<3>(random);
    sample.f_imu_mps2 +=
        truth.accel_bias + noise.accel_density * white * test::RandomVector<3>(random);
    return sample;
  };
  FilterHistory history(options, start, measured(0.0));
  const auto num_steps = static_cast<int>(std::lround(seconds / kImuStep_s));
  for (int i = 1; i <= num_steps; ++i) {
    const double walk = std::sqrt(kImuStep_s);
    truth.gyro_bias += noise.gyro_bias_walk_density * walk * test::RandomVector<3>(random);
    truth.accel_bias += noise.accel_bias_walk_density * walk * test::RandomVector<3>(random);
    const double t_s = i * kImuStep_s;
    history.AddImu(measured(t_s));
    if (i % 5 != 0) continue;
    PoseEvent event = PoseAt(t_s, Vector6::Zero(), kPoseStd);
    event.measurement.T_map_imu =
        T_map_world * TestMotion()(t_s) * ExpSe3(kPoseStd * test::RandomVector<6>(random));
    history.AddPose(StampAt(t_s), event);
  }
  const test::MotionState end = test::StateOf(TestMotion(), seconds);
  truth.T_world_imu = end.T_world_imu;
  truth.v_world_imu = end.v_world_imu;
  truth.T_map_imu = T_map_world * end.T_world_imu;
  return {truth, history.head()};
}

TEST(FilterHistory, NeesIsInItsBandWithWhiteNoiseOnAFixedMap) {
  constexpr int kRuns = 60;
  struct Block {
    const char* name;
    int at, size;
    double nees = 0;
  };
  std::vector<Block> blocks = {{"position", kPos, 3},       {"rotation", kRot, 3},
                               {"pose", kPos, 6},           {"velocity", kVel, 3},
                               {"gyro bias", kGyroBias, 3}, {"accel bias", kAccelBias, 3},
                               {"map pose", kMapPose, 6},   {"all", kPos, kStateDim}};
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const TruthRun run = RunWithNoise(seed, 8.0);
    const ErrorVector error = BoxMinus(run.truth, run.estimate.state);
    for (Block& block : blocks) {
      const Eigen::VectorXd part = error.segment(block.at, block.size);
      const Eigen::MatrixXd cov =
          run.estimate.cov.block(block.at, block.at, block.size, block.size);
      block.nees += part.dot(cov.ldlt().solve(part)) / (kRuns * block.size);
    }
  }
  for (const Block& block : blocks) {
    // Mean over the runs of a chi-square per degree of freedom: three standard deviations.
    const double band = 3.0 * std::sqrt(2.0 / (kRuns * block.size));
    EXPECT_NEAR(block.nees, 1.0, band) << block.name;
  }
}

}  // namespace
}  // namespace lio
