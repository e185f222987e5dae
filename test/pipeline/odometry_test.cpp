// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator as a whole on simulated drives.
#include "lio/pipeline/odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "lio/pipeline/registration_worker.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::DriveOptions;
using test::Driving;
using test::ErrorAgainst;
using test::ExpectStampsIncrease;
using test::LidarOnly;
using test::Message;
using test::Messages;
using test::MovingStartDrive;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::SortedByArrival;
using test::StampAt;
using test::StaticStartDrive;
using test::WithClockStep;
using test::WithoutImu;
using test::WithoutLidar;

// --- the plain run

TEST(Odometry, EveryScanAfterTheStartHasARow) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::DriveRig());
  const auto first = static_cast<std::size_t>(run.scans.front().scan.scan_seq);
  ASSERT_EQ(run.scans.size() + first, static_cast<std::size_t>(run.counters.num_scans));
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    ASSERT_TRUE(run.scans[i].filter.has_value());
    EXPECT_EQ(run.scans[i].scan.scan_seq, static_cast<std::int64_t>(first + i));
    EXPECT_EQ(run.scans[i].filter->nav.stamp, run.scans[i].scan.stamp);
  }
}

TEST(Odometry, ImuRateOutputFollowsTheMotion) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::DriveRig());
  EXPECT_GT(run.navs.size(), 450u);
  const test::Motion motion = RestThenDrive();
  double worst_mps = 0;
  double worst_radps = 0;
  for (const NavOutput& nav : run.navs) {
    const test::MotionState truth = test::StateOf(motion, SecondsOf(nav.stamp));
    worst_mps = std::max(worst_mps, (nav.v_world_imu_mps - truth.v_world_imu).norm());
    worst_radps = std::max(worst_radps, (nav.w_imu_radps - truth.w_imu).norm());
    EXPECT_EQ(nav.source, OdometrySource::kImuPropagated);
  }
  EXPECT_LT(worst_mps, 0.15);
  EXPECT_LT(worst_radps, 0.02);
}

TEST(Odometry, AnImuThatSamplesSlowlyIsTold) {
  for (const double step_s : {0.01, 0.05}) {
    DriveOptions options;
    options.motion = RestThenDrive();
    options.imu_step_s = step_s;
    const RunResult run = RunOdometry(SimulateDrive(test::Street(), options), test::DriveRig());
    EXPECT_EQ(test::HasNotice(run, "the IMU gives 20 samples a second"), step_s > 0.03);
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15) << step_s;
  }
}

TEST(Odometry, LidarAloneTracksTheDrive) {
  for (const bool has_samples : {true, false}) {
    Messages messages = StaticStartDrive();
    if (!has_samples) messages = WithoutImu(messages, -1.0, 100.0);
    const RunResult run = RunOdometry(messages, LidarOnly());
    EXPECT_EQ(run.scans.size(), static_cast<std::size_t>(run.counters.num_scans));
    ExpectStampsIncrease(run);
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15);
    EXPECT_EQ(run.counters.num_gated, 0);
  }
}

TEST(Odometry, LogWithoutImuIsTrackedByTheLidarAlone) {
  const Messages messages = WithoutImu(MovingStartDrive(4.0), -1.0, 100.0);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "lidar-only"));
  EXPECT_EQ(run.scans.size(), static_cast<std::size_t>(run.counters.num_scans));
  EXPECT_LT(ErrorAgainst(Driving(), run.scans, 0.35).max_m, 0.3);
}

TEST(Odometry, LogOfASecondWithoutImuIsTrackedAtItsEnd) {
  const Messages messages = WithoutImu(MovingStartDrive(1.0), -1.0, 100.0);
  EXPECT_EQ(RunOdometry(messages, test::DriveRig()).scans.size(), 10u);
}

TEST(Odometry, GravityFreeImuIsTracked) {
  DriveOptions drive;
  drive.motion = RestThenDrive();
  drive.g_world = Vector3::Zero();
  drive.to_s = 5.0;
  const RunResult run = RunOdometry(SimulateDrive(test::Street(), drive), test::DriveRig());
  ASSERT_FALSE(run.scans.empty());
  EXPECT_TRUE(test::HasNotice(run, "without gravity"));
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.1);
}

TEST(Odometry, RefusesFaultyOptions) {
  Options options = test::DriveRig();
  options.ndt.voxel_m = -1.0;
  options.rig.T_imu_lidar.reset();
  try {
    Odometry odometry(options);
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("ndt.voxel_m"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("rig.T_imu_lidar"), std::string::npos);
  }
}

TEST(Odometry, NothingComesOfNothing) {
  const RunResult run = RunOdometry({}, test::DriveRig());
  EXPECT_TRUE(run.scans.empty());
  EXPECT_EQ(run.status, TrackingStatus::kInit);
}

// --- the same answer whenever jobs are finished

Options WithBase() {
  Options options = test::DriveRig();
  options.rig.T_base_imu = Pose{ExpSo3(Vector3(0, 0, 1)), Vector3(1, 0, 0.5)};
  return options;
}

Options WithClockOffset() {
  Options options = test::DriveRig();
  options.filter.estimate_clock_offset = true;
  return options;
}

struct LagCase {
  const char* name;
  std::function<Messages()> messages;
  Options options = test::DriveRig();
};

std::vector<LagCase> LagCases() {
  const auto shift_imu = [](Messages messages, double by_s) {
    for (Message& message : messages) {
      if (message.is_imu) message.arrival = message.arrival + Duration::FromSeconds(by_s);
    }
    return SortedByArrival(std::move(messages));
  };
  const auto early_imu = [] {
    DriveOptions drive;
    drive.motion = Driving();
    drive.imu_from_s = -8.0;
    drive.to_s = 3.0;
    return SimulateDrive(test::Street(), drive);
  };
  return {
      {"clean", [] { return StaticStartDrive(); }},
      {"with a base frame", [] { return StaticStartDrive(); }, WithBase()},
      {"with the clocks' offset", [] { return StaticStartDrive(); }, WithClockOffset()},
      {"moving start", [] { return MovingStartDrive(); }},
      {"moving start, IMU long before", early_imu},
      {"lidar alone", [] { return StaticStartDrive(); }, LidarOnly()},
      {"no IMU", [] { return WithoutImu(MovingStartDrive(4.0), -1.0, 100.0); }},
      {"gap of the IMU", [] { return WithoutImu(StaticStartDrive(), 3.0, 3.6); }},
      {"long gap of the IMU", [] { return WithoutImu(StaticStartDrive(), 3.0, 4.7); }},
      {"gap of the lidar", [] { return WithoutLidar(StaticStartDrive(), 3.0, 3.6); }},
      {"IMU dies", [] { return WithoutImu(StaticStartDrive(), 3.0, 100.0); }},
      {"IMU sent late", [&] { return shift_imu(StaticStartDrive(), 0.3); }},
      {"IMU sent very late", [&] { return shift_imu(StaticStartDrive(), 1.3); }},
      {"clocks set forward", [] { return WithClockStep(StaticStartDrive(), 3.5, 100.0); }},
      {"clocks set back", [] { return WithClockStep(StaticStartDrive(), 3.5, -100.0); }},
  };
}

TEST(Odometry, SameBytesWheneverJobsAreFinished) {
  for (const LagCase& c : LagCases()) {
    const Messages messages = c.messages();
    const std::string at_once = Bytes(RunOdometry(messages, c.options).scans);
    EXPECT_GT(at_once.size(), 1000u) << c.name;
    for (const int lag : {1, 5, 11}) {
      EXPECT_TRUE(Bytes(RunOdometry(messages, c.options, lag).scans) == at_once)
          << c.name << ", outcomes " << lag << " messages late";
    }
  }
}

TEST(Odometry, SameBytesForTheSameInput) {
  const RunResult a = RunOdometry(StaticStartDrive(), test::DriveRig());
  const RunResult b = RunOdometry(StaticStartDrive(), test::DriveRig());
  EXPECT_TRUE(Bytes(a.scans) == Bytes(b.scans));
}

// --- overload

TEST(Odometry, OverloadDropsTheOldestScansAndCountsThem) {
  const Options options = test::DriveRig();
  Odometry odometry(options);
  RegistrationWorker matching(options);
  std::set<std::int64_t> seqs;
  int count = 0;
  for (const Message& message : StaticStartDrive()) {
    message.is_imu ? odometry.AddImu(message.sample) : odometry.AddChunk(message.chunk);
    odometry.ShedLoad();
    if (message.arrival > StampAt(3.0) && ++count % 250 != 0) continue;  // stalls for two seconds
    while (auto job = odometry.NextJob()) {
      matching.Insert(odometry.FinishJob(matching.Run(*job)));
    }
    for (const Output& output : odometry.TakeOutputs()) {
      if (const auto* scan = std::get_if<ScanOutput>(&output)) seqs.insert(scan->scan.scan_seq);
    }
  }
  EXPECT_GT(odometry.counters().num_scans_dropped, 10);
  EXPECT_GT(*seqs.rbegin(), 45) << "the newest scans are the ones that are kept";
  EXPECT_EQ(odometry.counters().num_imu_late, 0);
}

}  // namespace
}  // namespace lio
