// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A scan whose motion nobody has measured.
#include <gtest/gtest.h>

#include "lio/pipeline/registration_worker.hpp"
#include "support/street_job.hpp"

namespace lio {
namespace {

using test::Driving;
using test::StreetJob;

// The prediction has missed a turn of this rate since the last scan.
MatchJob JobWithoutTurn(double start_s, double rate_radps) {
  MatchJob job = StreetJob(start_s);
  job.prior.since_last_fix_s = 0.1;
  for (StampedPose& pose : job.T_any_imu) {
    const double since_s = SecondsBetween(job.sweep->middle(), pose.stamp) + 0.1;
    pose.pose.rotation = pose.pose.rotation * ExpSo3(Vector3(0, 0, -rate_radps * since_s));
  }
  job.prior.T_map_imu.rotation =
      job.prior.T_map_imu.rotation * ExpSo3(Vector3(0, 0, -0.1 * rate_radps));
  job.prior.cov.diagonal().tail<3>().setConstant(0.02);
  job.task = Relocalize{{}, {SearchRegion::kAnywhere, {}}};
  job.refines_deskew = true;
  job.bends_scan = true;
  return job;
}

class BendingMatch : public testing::Test {
 protected:
  BendingMatch() {
    for (int i = 0; i < 10; ++i) {
      MatchOutcome outcome = side_.Run(StreetJob(0.1 * i));
      side_.Insert(
          {.points_imu = std::move(outcome.points_imu), .T_map_imu = Driving()(0.1 * i + 0.05)});
    }
  }
  RegistrationWorker side_{test::DriveRig()};
};

TEST_F(BendingMatch, ScanIsFoundAfterAQuickTurnEitherWay) {
  for (const double rate_radps : {-2.5, -2.0, 2.0, 2.5}) {
    const MatchOutcome outcome = side_.Run(JobWithoutTurn(1.0, rate_radps));
    ASSERT_TRUE(outcome.match.IsUsable());
    EXPECT_FALSE(outcome.is_relocalized);
    EXPECT_GT(outcome.num_coarse_matches, 0);
    const Pose error = Driving()(1.05).Inverse() * outcome.match.T_map_imu;
    EXPECT_LT(error.translation.norm(), 0.05);
    EXPECT_LT(LogSo3(error.rotation).norm(), 0.005);
  }
}

TEST_F(BendingMatch, ScanNearThePriorNeedsNoSearch) {
  const MatchOutcome outcome = side_.Run(JobWithoutTurn(1.0, 0.3));
  ASSERT_TRUE(outcome.match.IsUsable());
  EXPECT_EQ(outcome.num_coarse_matches, 0);
  EXPECT_LE(outcome.num_matches, 2);
  const Pose error = Driving()(1.05).Inverse() * outcome.match.T_map_imu;
  EXPECT_LT(error.translation.norm(), 0.05);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.005);
}

}  // namespace
}  // namespace lio
