// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/registration_worker.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/simulated_drive.hpp"

namespace lio {
namespace {

using test::Driving;
using test::StampAt;

std::shared_ptr<const Sweep> StreetSweepFrom(double start_s) {
  std::mt19937_64 random(static_cast<unsigned>(1000 * start_s));
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(start_s);
  sweep->end = StampAt(start_s + 0.1);
  sweep->decode_ns = 5;
  sweep->points = test::CastSweep(test::Street(), test::TestLidar(), Driving(), start_s, random);
  return sweep;
}

// Returns the job with the true motion, the guess off by `guess_error` at the sweep's middle.
MatchJob JobFor(const std::shared_ptr<const Sweep>& sweep,
                const Vector6& guess_error = Vector6::Zero()) {
  MatchJob job;
  job.sweep = sweep;
  const double start_s = test::SecondsOf(sweep->start);
  for (int i = 0; i <= 10; ++i) {
    job.T_any_imu.push_back({StampAt(start_s + 0.01 * i), Driving()(start_s + 0.01 * i)});
  }
  job.prior.T_map_imu = Driving()(start_s + 0.05) * ExpSe3(guess_error);
  job.prior.cov = 0.01 * Matrix6::Identity();
  job.prior.cov.bottomRightCorner<3, 3>() *= 0.0025;
  return job;
}

// Matches and inserts the scans of a second, each at its true pose.
void FillMap(RegistrationWorker& side) {
  for (int i = 0; i < 10; ++i) {
    const auto sweep = StreetSweepFrom(0.1 * i);
    MatchOutcome outcome = side.Run(JobFor(sweep));
    side.Insert(
        {.points_imu = std::move(outcome.points_imu), .T_map_imu = Driving()(0.1 * i + 0.05)});
  }
}

double ErrorOf(const MatchOutcome& outcome) {
  const Pose truth = Driving()(test::SecondsOf(outcome.sweep->middle()));
  return (outcome.match.T_map_imu.translation - truth.translation).norm();
}

TEST(RegistrationWorker, FirstScanFindsAnEmptyMapAndFillsIt) {
  RegistrationWorker side(test::DriveRig());
  MatchOutcome outcome = side.Run(JobFor(StreetSweepFrom(0.0)));
  EXPECT_EQ(outcome.match.status, MatchStatus::kEmptyMap);
  EXPECT_GT(outcome.points_imu.size(), 2000u);
  EXPECT_EQ(side.matcher().map_size().num_cells, 0u);
  side.Insert({.points_imu = outcome.points_imu, .T_map_imu = Driving()(0.05)});
  EXPECT_GT(side.matcher().map_size().num_cells, 200u);
}

TEST(RegistrationWorker, TaskWithoutAPoseIsNotInserted) {
  RegistrationWorker side(test::DriveRig());
  MatchOutcome outcome = side.Run(JobFor(StreetSweepFrom(0.0)));
  side.Insert({.points_imu = outcome.points_imu, .T_map_imu = std::nullopt});
  EXPECT_EQ(side.matcher().map_size().num_cells, 0u);
}

TEST(RegistrationWorker, BeamsAreThoseOfTheRigUntilNdtFindsMore) {
  Options options;
  EXPECT_FALSE(RegistrationWorker(options).FoundBeams());
  options.rig.lidar.beams =
      LidarBeams{{0.01}, {0.004}, {0}, {1e-4}, {0}, {1e-4}, {0, 0}, {1e-5, 1e-5}};
  const std::optional<LidarBeams> known = RegistrationWorker(options).FoundBeams();
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->range_m[0], 0.01, 1e-6);
  options.pipeline.method = MatchMethod::kLoam;
  EXPECT_FALSE(RegistrationWorker(options).FoundBeams()) << "LOAM finds none";
}

TEST(RegistrationWorker, ScanOfAMovingVehicleIsFoundAtItsMiddle) {
  RegistrationWorker side(test::DriveRig());
  FillMap(side);
  Vector6 guess_error;
  guess_error << 0.1, -0.1, 0.05, 0.003, -0.002, 0.004;
  const MatchOutcome outcome = side.Run(JobFor(StreetSweepFrom(1.0), guess_error));
  ASSERT_TRUE(outcome.match.IsUsable());
  EXPECT_LT(ErrorOf(outcome), 0.02);
  EXPECT_GT(outcome.num_used, 1000);
}

TEST(RegistrationWorker, JobMayClearTheMap) {
  RegistrationWorker side(test::DriveRig());
  FillMap(side);
  MatchJob job = JobFor(StreetSweepFrom(1.0));
  job.map_action = MapAction::kClear;
  EXPECT_EQ(side.Run(job).match.status, MatchStatus::kEmptyMap);
  EXPECT_EQ(side.matcher().map_size().num_cells, 0u);
}

// The middle is guessed right, the turn rate wrong: only what is smeared tells of that.
TEST(RegistrationWorker, SweepShowsTheTurnRateThatTheGuessHasWrong) {
  RegistrationWorker side(test::DriveRig());
  FillMap(side);
  MatchJob job = JobFor(StreetSweepFrom(1.0));
  const Vector3 true_rate =
      LogSo3(job.T_any_imu.front().pose.rotation.conjugate() * job.T_any_imu.back().pose.rotation) /
      SecondsBetween(job.T_any_imu.front().stamp, job.T_any_imu.back().stamp);
  const Vector3 rate_error(0.05, -0.08, 0.1);
  for (StampedPose& pose : job.T_any_imu) {
    const double from_mid_sweep_s = SecondsBetween(job.sweep->middle(), pose.stamp);
    pose.pose.rotation = pose.pose.rotation * ExpSo3(from_mid_sweep_s * rate_error);
  }
  EXPECT_FALSE(side.Run(job).turn_rate) << "nobody asked";
  job.refines_deskew = true;
  const MatchOutcome outcome = side.Run(job);
  ASSERT_TRUE(outcome.turn_rate);
  EXPECT_LT((outcome.turn_rate->w_imu_radps - true_rate).norm(), 0.2 * rate_error.norm());
  EXPECT_LT(outcome.turn_rate->cov.diagonal().cwiseSqrt().maxCoeff(), 0.05);
}

// A constant-velocity guess that is off by 2 m/s smears the scan by 20 cm; deskewing again along
// what was found takes the smear out.
TEST(RegistrationWorker, DeskewIsRefinedWhenTheMotionIsOnlyGuessed) {
  const auto outcome_of = [](double velocity_error_mps, bool refine) {
    RegistrationWorker side(test::DriveRig());
    FillMap(side);
    MatchJob job = JobFor(StreetSweepFrom(1.0));
    job.refines_deskew = refine;
    job.prior.since_last_fix_s = 0.1;
    const Vector6 velocity_error = velocity_error_mps * Vector6::Unit(0);
    for (StampedPose& pose : job.T_any_imu) {
      const double since_s = SecondsBetween(job.sweep->middle(), pose.stamp) + 0.1;
      pose.pose = pose.pose * ExpSe3(since_s * velocity_error);
    }
    job.prior.T_map_imu = job.prior.T_map_imu * ExpSe3(0.1 * velocity_error);
    MatchOutcome outcome = side.Run(job);
    EXPECT_TRUE(outcome.match.IsUsable());
    return outcome;
  };
  const MatchOutcome refined = outcome_of(2.0, true);
  EXPECT_LT(ErrorOf(refined), 0.005);
  EXPECT_GT(refined.match.by_level.num_in_finest, 0);
  const std::vector<Eigen::Vector3f> truth = outcome_of(0.0, false).points_imu;
  const auto smear_m = [&](const std::vector<Eigen::Vector3f>& points) {
    double sum_sq = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum_sq += static_cast<double>((points[i] - truth.at(i)).squaredNorm());
    }
    return std::sqrt(sum_sq / static_cast<double>(points.size()));
  };
  EXPECT_LT(smear_m(refined.points_imu), 0.005);
  EXPECT_GT(smear_m(outcome_of(2.0, false).points_imu), 0.05);
}

TEST(RegistrationWorker, SweepWithoutAFinitePointIsRefusedNotFatal) {
  for (const bool has_map : {false, true}) {
    RegistrationWorker side(test::DriveRig());
    if (has_map) FillMap(side);
    Sweep blind = *StreetSweepFrom(1.0);
    for (LidarPoint& point : blind.points) point.y_m = std::numeric_limits<float>::quiet_NaN();
    const auto num_points = static_cast<int>(blind.points.size());
    MatchOutcome outcome = side.Run(JobFor(std::make_shared<const Sweep>(std::move(blind))));
    EXPECT_FALSE(outcome.match.IsUsable());
    EXPECT_EQ(outcome.num_nonfinite, num_points);
    EXPECT_EQ(outcome.num_used, 0);
    side.Insert({.points_imu = outcome.points_imu, .T_map_imu = Pose{}});
  }
}

std::int64_t g_now_ns = 0;
std::int64_t TickingClock() {
  return g_now_ns += 10;
}

TEST(RegistrationWorker, StageTimesComeFromTheGivenClock) {
  RegistrationWorker side(test::DriveRig(), &TickingClock);
  MatchJob job = JobFor(StreetSweepFrom(0.0));
  job.filter_ns = 33;
  const auto time = [](const MatchOutcome& outcome, Stage stage) {
    return outcome.stage_ns[static_cast<std::size_t>(stage)];
  };
  MatchOutcome first = side.Run(job);
  EXPECT_EQ(time(first, Stage::kDecode), 5);
  EXPECT_EQ(time(first, Stage::kFilter), 33);
  EXPECT_GT(time(first, Stage::kReduce), 0);
  EXPECT_GT(time(first, Stage::kDeskew), 0);
  EXPECT_GT(time(first, Stage::kMatch), 0);
  EXPECT_EQ(time(first, Stage::kInsert), 0) << "nothing was inserted before";
  side.Insert({.points_imu = first.points_imu, .T_map_imu = Driving()(0.05)});
  EXPECT_GT(time(side.Run(JobFor(StreetSweepFrom(0.1))), Stage::kInsert), 0);
  EXPECT_EQ(time(side.Run(JobFor(StreetSweepFrom(0.2))), Stage::kInsert), 0) << "counted once";
}

TEST(RegistrationWorker, WithoutAClockThereAreNoTimes) {
  RegistrationWorker side(test::DriveRig());
  const MatchOutcome outcome = side.Run(JobFor(StreetSweepFrom(0.0)));
  EXPECT_EQ(outcome.stage_ns[static_cast<std::size_t>(Stage::kMatch)], 0);
}

}  // namespace
}  // namespace lio
