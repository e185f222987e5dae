// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A scan that is not found where it was guessed.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/pipeline/registration_worker.hpp"
#include "support/street_job.hpp"

namespace lio {
namespace {

using test::Driving;

MatchJob GuessedJob(double start_s, const Vector6& guess_error) {
  MatchJob job = test::StreetJob(start_s);
  job.prior.T_map_imu = job.prior.T_map_imu * ExpSe3(guess_error);
  return job;
}

// A job whose prior has a standard deviation of 2 m and 0.2 rad.
MatchJob UnsureJobFor(double start_s, const Vector6& guess_error) {
  MatchJob job = GuessedJob(start_s, guess_error);
  job.prior.cov.diagonal() << Vector3::Constant(4.0), Vector3::Constant(0.04);
  job.task = Relocalize{{}, {SearchRegion::kAnywhere, {}}};
  job.refines_deskew = true;
  job.prior.since_last_fix_s = 0.5;
  return job;
}

void FillMapAhead(RegistrationWorker& side) {
  for (int i = 0; i < 10; ++i) {
    MatchOutcome outcome = side.Run(GuessedJob(0.1 * i, Vector6::Zero()));
    side.Insert(
        {.points_imu = std::move(outcome.points_imu), .T_map_imu = Driving()(0.1 * i + 0.05)});
  }
}

// As after a clock that jumped: the motion of a second that never was.
Vector6 FarAhead() {
  Vector6 error;
  error << 12.0, 3.0, 1.5, 0.0, 0.0, 0.3;
  return error;
}

TEST(RegistrationWorkerPlace, AScanGuessedFarAheadIsFoundWhereTheLastOneWas) {
  RegistrationWorker side(test::DriveRig());
  FillMapAhead(side);
  const MatchOutcome outcome = side.Run(UnsureJobFor(0.93, FarAhead()));
  ASSERT_TRUE(outcome.match.IsUsable());
  EXPECT_TRUE(outcome.is_relocalized);
  const Pose error = Driving()(0.98).Inverse() * outcome.match.T_map_imu;
  EXPECT_LT(error.translation.norm(), 0.1);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.01);
}

// The scan sees a street that the map has not: every candidate is tried in vain.
TEST(RegistrationWorkerPlace, AtMostFourFullMatchesRunForAScan) {
  RegistrationWorker side(test::DriveRig());
  FillMapAhead(side);
  int most = 0;
  int num_coarse = 0;
  for (int i = 0; i < 4; ++i) {
    MatchJob job = UnsureJobFor(6.0 + 0.1 * i, Vector6::Zero());
    job.prior.T_map_imu = Driving()(1.0) * ExpSe3(FarAhead());
    job.task = Relocalize{{}, {SearchRegion::kAnywhere, Driving()(0.5)}};
    const MatchOutcome outcome = side.Run(job);
    const int num_matches = outcome.num_matches;
    num_coarse += outcome.num_coarse_matches;
    EXPECT_LE(num_matches, 4);
    most = std::max(most, num_matches);
  }
  EXPECT_GE(most, 3) << "it was searched for";
  EXPECT_GE(num_coarse, 4) << "candidates were ranked";
}

TEST(RegistrationWorkerPlace, AScanThatIsFoundAsGuessedIsNotSought) {
  RegistrationWorker side(test::DriveRig());
  FillMapAhead(side);
  const MatchOutcome outcome = side.Run(UnsureJobFor(1.0, Vector6::Zero()));
  EXPECT_TRUE(outcome.match.IsUsable());
  EXPECT_FALSE(outcome.is_relocalized);
}

TEST(RegistrationWorkerPlace, WithoutLeaveToSeekItIsNot) {
  RegistrationWorker side(test::DriveRig());
  FillMapAhead(side);
  MatchJob job = UnsureJobFor(0.93, FarAhead());
  job.task = Track{};
  EXPECT_FALSE(side.Run(job).is_relocalized);
}

// After stamps that went a second forth: did the vehicle drive on, or was the clock set?
TEST(RegistrationWorkerPlace, WhereNoTimeHasPassedTheScanIsFoundThere) {
  for (const bool was_set : {true, false}) {
    RegistrationWorker side(test::DriveRig());
    FillMapAhead(side);
    const Vector6 way = FarAhead();
    MatchJob job = GuessedJob(0.93, was_set ? way : Vector6(Vector6::Zero()));
    const Pose alternative =
        Driving()(0.98) * ExpSe3(was_set ? Vector6(Vector6::Zero()) : Vector6(-way));
    job.task = Relocalize{{}, {SearchRegion::kObservable, alternative}};
    const MatchOutcome outcome = side.Run(job);
    EXPECT_EQ(outcome.is_clock_set, was_set);
    ASSERT_TRUE(outcome.match.IsUsable());
    EXPECT_LT((Driving()(0.98).Inverse() * outcome.match.T_map_imu).translation.norm(), 0.05);
  }
}

}  // namespace
}  // namespace lio
