// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Odometry::Reset: a new beginning that depends on what follows alone.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <utility>

#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Messages;

constexpr double kReset_s = 0.5;  // the body of the drive still rests

// The estimator over these messages; all that is matched is matched at once.
class Feeder {
 public:
  explicit Feeder(const Options& options) : options_(options), odometry_(options) {
    worker_.emplace(options_);
  }
  void Reset(const std::optional<GivenPose>& at = {}, Timestamp stamp = {}) {
    odometry_.Reset(at, stamp);
    job_out_ = std::exchange(worker_, std::nullopt);
    worker_.emplace(options_);
  }
  // Finishes a job from before the reset.
  void DoLate(const MatchJob& job) { worker_->Insert(odometry_.FinishJob(job_out_->Run(job))); }

  void Feed(const Messages& messages) {
    for (const test::Message& message : messages) {
      Add(message);
      while (auto job = odometry_.NextJob()) Do(*job);
      Take();
    }
  }
  void Add(const test::Message& message) {
    if (message.is_imu) {
      odometry_.AddImu(message.sample);
    } else {
      odometry_.AddChunk(message.chunk);
    }
  }
  void Do(const MatchJob& job) { worker_->Insert(odometry_.FinishJob(worker_->Run(job))); }
  void Take() {
    for (Output& output : odometry_.TakeOutputs()) {
      if (auto* scan = std::get_if<ScanOutput>(&output)) scans.push_back(std::move(*scan));
    }
  }
  Odometry& odometry() { return odometry_; }
  std::vector<ScanOutput> scans;

 private:
  Options options_;
  Odometry odometry_;
  std::optional<RegistrationWorker> worker_;
  std::optional<RegistrationWorker> job_out_;  // from before the reset
};

struct Halves {
  Messages before, after;
};
Halves SplitDrive() {
  Halves halves;
  for (const test::Message& message : test::StaticStartDrive()) {
    (test::SecondsOf(message.arrival) < kReset_s ? halves.before : halves.after).push_back(message);
  }
  return halves;
}

TEST(OdometryReset, WhatFollowsIsThatOfANewEstimatorBitByBit) {
  const Halves drive = SplitDrive();
  Feeder fresh(test::DriveRig());
  fresh.Feed(drive.after);
  ASSERT_GT(fresh.scans.size(), 10u);
  Feeder reset(test::DriveRig());
  reset.Feed(drive.before);
  const auto num_before = reset.odometry().counters().num_imu;
  reset.scans.clear();
  reset.Reset();
  reset.Feed(drive.after);
  EXPECT_TRUE(test::Bytes(reset.scans) == test::Bytes(fresh.scans));
  EXPECT_EQ(reset.odometry().counters().num_imu, num_before + fresh.odometry().counters().num_imu);
  EXPECT_EQ(reset.odometry().counters().num_restarts, fresh.odometry().counters().num_restarts + 1);
}

// Whether a job is out depends on how fast the matching thread is, and must not tell.
TEST(OdometryReset, AJobThatIsOutHasNoEffect) {
  const Halves drive = SplitDrive();
  Feeder fresh(test::DriveRig());
  fresh.Feed(drive.after);
  Feeder reset(test::DriveRig());
  std::optional<MatchJob> out;
  for (const test::Message& message : drive.before) {
    reset.Add(message);
    if (!out) out = reset.odometry().NextJob();
  }
  ASSERT_TRUE(out);
  reset.Reset();
  reset.DoLate(*out);
  reset.Take();
  EXPECT_TRUE(reset.scans.empty());
  reset.Feed(drive.after);
  EXPECT_TRUE(test::Bytes(reset.scans) == test::Bytes(fresh.scans));
}

TEST(OdometryReset, AGivenPosePlacesTheWorld) {
  const Halves drive = SplitDrive();
  GivenPose at;
  at.T_world_imu = {Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitZ())),
                    {100.0, -20.0, 3.0}};
  at.cov.diagonal() << 0.25, 0.16, 0.09, 0.0, 0.0, 0.01;
  Feeder fresh(test::DriveRig());
  fresh.Feed(drive.after);
  for (const bool uses_imu : {true, false}) {
    Options options = test::DriveRig();
    options.pipeline.use_imu = uses_imu;
    Feeder run(options);
    run.Reset(at, drive.before.back().arrival);
    run.Feed(drive.after);
    ASSERT_FALSE(run.scans.empty());
    const NavOutput& nav = run.scans.front().filter->nav;
    EXPECT_LT((nav.T_world_imu.translation - at.T_world_imu.translation).norm(), 0.3) << uses_imu;
    EXPECT_NEAR(LogSo3(nav.T_world_imu.rotation).z(), std::numbers::pi / 2, 0.05) << uses_imu;
    for (const int axis : {0, 1, 2, 5}) {
      EXPECT_GE(nav.pose_cov(axis, axis), at.cov(axis, axis)) << uses_imu << axis;
    }
    if (!uses_imu) continue;
    // The path is the same one, seen from elsewhere.
    ASSERT_EQ(run.scans.size(), fresh.scans.size());
    const auto moved = [](const Feeder& of) {
      return (of.scans.back().filter->nav.T_world_imu.translation -
              of.scans.front().filter->nav.T_world_imu.translation)
          .norm();
    };
    EXPECT_NEAR(moved(run), moved(fresh), 0.01) << "the voxels lie otherwise";
  }
}

}  // namespace
}  // namespace lio
