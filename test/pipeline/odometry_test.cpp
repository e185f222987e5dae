// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator as a whole on simulated drives, clean and with every kind of fault.
#include "lio/pipeline/odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "lio/pipeline/match_side.hpp"
#include "support/simulated_drive.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::DriveOptions;
using test::ErrorAgainst;
using test::Message;
using test::Messages;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::StampAt;
using test::TrackError;

constexpr double kRest_s = 1.5;
constexpr double kEnd_s = 6.5;

test::Motion RestThenDrive() {
  return test::WindingDrive(kRest_s);
}

// Starts its clock 4 s into the drive: at 8 m/s, turning.
test::Motion Driving() {
  return [](double t_s) { return test::WindingDrive(0.0)(t_s + 4.0); };
}

const Messages& StaticStartDrive() {
  static const Messages kMessages = [] {
    DriveOptions options;
    options.motion = RestThenDrive();
    options.to_s = kEnd_s;
    return SimulateDrive(test::Street(), options);
  }();
  return kMessages;
}

Messages MovingStartDrive(double to_s = 5.0) {
  DriveOptions options;
  options.motion = Driving();
  options.to_s = to_s;
  return SimulateDrive(test::Street(), options);
}

Options LidarOnly() {
  Options options = test::DriveRig();
  options.pipeline.use_imu = false;
  return options;
}

Messages Where(const Messages& messages, const std::function<bool(const Message&)>& is_kept) {
  Messages kept;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(kept), is_kept);
  return kept;
}

bool IsBetween(const Message& message, double from_s, double to_s) {
  return message.arrival >= StampAt(from_s) && message.arrival < StampAt(to_s);
}

Messages WithoutImu(const Messages& messages, double from_s, double to_s) {
  return Where(messages, [=](const Message& message) {
    return !(message.is_imu && IsBetween(message, from_s, to_s));
  });
}

Messages WithoutLidar(const Messages& messages, double from_s, double to_s) {
  return Where(messages, [=](const Message& message) {
    return message.is_imu || !IsBetween(message, from_s, to_s);
  });
}

// Stamps of both sensors, of one of them by choice, moved by `shift_s` from `from_s` on.
Messages WithClockStep(Messages messages, double from_s, double shift_s, bool imu = true,
                       bool lidar = true) {
  for (Message& message : messages) {
    if (message.arrival < StampAt(from_s)) continue;
    const Duration shift = Duration::FromSeconds(shift_s);
    if (message.is_imu && imu) message.sample.stamp = message.sample.stamp + shift;
    if (!message.is_imu && lidar) message.chunk.stamp = message.chunk.stamp + shift;
  }
  return messages;
}

Messages SortedByArrival(Messages messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.arrival < b.arrival; });
  return messages;
}

void ExpectStampsIncrease(const RunResult& run) {
  for (std::size_t i = 1; i < run.scans.size(); ++i) {
    ASSERT_GT(run.scans[i].scan.stamp, run.scans[i - 1].scan.stamp) << "scan " << i;
  }
  for (std::size_t i = 1; i < run.navs.size(); ++i) {
    ASSERT_GT(run.navs[i].stamp, run.navs[i - 1].stamp) << "sample " << i;
  }
}

int NumFused(const RunResult& run) {
  return static_cast<int>(std::count_if(run.scans.begin(), run.scans.end(),
                                        [](const ScanOutput& s) { return s.scan.fused; }));
}

// All counters of faults are zero.
void ExpectClean(const Counters& c) {
  for (const std::int64_t count :
       {c.num_imu_nonfinite, c.num_imu_duplicate, c.num_imu_late, c.num_imu_out_of_range,
        c.num_imu_gaps, c.num_chunks_duplicate, c.num_chunks_late, c.num_chunks_missing,
        c.num_chunks_bad, c.num_points_nonfinite, c.num_scans_empty, c.num_scans_dropped,
        c.num_scans_late, c.num_scans_without_imu, c.num_scan_gaps, c.num_matches_rejected,
        c.num_gated, c.num_clock_jumps, c.num_restarts}) {
    EXPECT_EQ(count, 0);
  }
}

// --- the plain run

TEST(Odometry, StaticStartTracksTheDrive) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::DriveRig());
  ASSERT_FALSE(run.scans.empty());
  ExpectClean(run.counters);
  ExpectStampsIncrease(run);
  EXPECT_TRUE(test::HasNotice(run, "at rest"));
  EXPECT_LT(SecondsOf(run.scans.front().scan.stamp), 1.5) << "rows after 1.5 s of rest at most";
  const TrackError error = ErrorAgainst(RestThenDrive(), run.scans);
  EXPECT_LT(error.max_m, 0.06);
  EXPECT_LT(error.max_rad, 0.005);
  EXPECT_LT(error.max_tilt_rad, 0.009);  // half a degree
  EXPECT_EQ(run.status, TrackingStatus::kOk);
}

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

TEST(Odometry, MovingStartTracksTheDrive) {
  const RunResult run = RunOdometry(MovingStartDrive(), test::DriveRig());
  ASSERT_FALSE(run.scans.empty());
  EXPECT_TRUE(test::HasNotice(run, "in motion"));
  ExpectStampsIncrease(run);
  EXPECT_EQ(run.counters.num_restarts, 0);
  EXPECT_LT(ErrorAgainst(Driving(), run.scans).max_m, 0.3);
  const TrackError settled = ErrorAgainst(Driving(), run.scans, 3.0);
  EXPECT_LT(settled.max_m, 0.1);
  EXPECT_LT(settled.max_tilt_rad, 0.0175);  // a degree, after 3 s
  const NavOutput& last = run.scans.back().filter->nav;
  const test::MotionState truth = test::StateOf(Driving(), SecondsOf(last.stamp));
  const Vector3 v_imu = last.T_world_imu.rotation.conjugate() * last.v_world_imu_mps;
  EXPECT_LT((v_imu - truth.T_world_imu.rotation.conjugate() * truth.v_world_imu).norm(), 0.2);
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

// --- faults of messages

TEST(Odometry, DuplicatesChangeNothing) {
  Messages doubled;
  for (const Message& message : StaticStartDrive()) {
    doubled.push_back(message);
    doubled.push_back(message);
  }
  const RunResult run = RunOdometry(doubled, test::DriveRig());
  const RunResult plain = RunOdometry(StaticStartDrive(), test::DriveRig());
  EXPECT_TRUE(Bytes(run.scans) == Bytes(plain.scans));
  EXPECT_EQ(run.counters.num_imu_duplicate + run.counters.num_imu_late, plain.counters.num_imu);
  EXPECT_EQ(run.counters.num_chunks_duplicate + run.counters.num_chunks_late,
            plain.counters.num_chunks);
}

TEST(Odometry, OutOfOrderSamplesChangeNothing) {
  Messages messages = StaticStartDrive();
  // Every third sample comes 30 ms late: before any sweep that needs it is closed by others.
  int count = 0;
  for (Message& message : messages) {
    if (message.is_imu && ++count % 3 == 0) {
      message.arrival = message.arrival + Duration::FromSeconds(0.03);
    }
  }
  const RunResult run = RunOdometry(SortedByArrival(messages), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_duplicate, 0);
  EXPECT_LT(run.counters.num_imu_late, 200);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, LateSamplesAreCountedAndLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (message.is_imu && IsBetween(message, 3.0, 3.02)) {
      message.arrival = message.arrival + Duration::FromSeconds(0.7);
    }
  }
  const RunResult run = RunOdometry(SortedByArrival(messages), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_late, 2);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

TEST(Odometry, NonFiniteSamplesAreLeftOut) {
  Messages messages = StaticStartDrive();
  int num_bad = 0;
  for (std::size_t i = 0; i < messages.size(); i += 17) {
    if (!messages[i].is_imu) continue;
    messages[i].sample.f_imu_mps2.y() = std::numeric_limits<double>::quiet_NaN();
    ++num_bad;
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_nonfinite, num_bad);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

TEST(Odometry, NonFinitePointsAreLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    for (std::size_t i = 0; i < message.chunk.points.size(); i += 3) {
      message.chunk.points[i].x_m = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GT(run.counters.num_points_nonfinite, 10000);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

void MakeBlind(Message& message) {
  for (LidarPoint& point : message.chunk.points) {
    point.x_m = point.y_m = point.z_m = std::numeric_limits<float>::quiet_NaN();
  }
}

TEST(Odometry, FirstSweepsWithoutAFinitePointAreSurvived) {
  for (const Options& options : {test::DriveRig(), LidarOnly()}) {
    Messages messages = StaticStartDrive();
    for (Message& message : messages) {
      if (IsBetween(message, -1.0, 0.35)) MakeBlind(message);
    }
    const RunResult run = RunOdometry(messages, options);
    ASSERT_FALSE(run.scans.empty());
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans, 1.0).max_m, 0.15);
  }
}

// A second without one return while driving: the IMU carries on, and the map it comes back to is
// the old one, not a new one begun where the filter then believed itself.
TEST(Odometry, BlindSweepsAreCarriedByTheImu) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (IsBetween(message, 4.0, 5.0)) MakeBlind(message);
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GE(run.counters.num_matches_rejected, 9);
  EXPECT_EQ(run.counters.num_gated, 0);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.06);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BlindSweepsWidenTheCovarianceUntilTheLidarSeesAgain) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (IsBetween(message, 4.0, 5.0)) MakeBlind(message);
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  double before = 0, blind = 0, after = 0;  // variance of the pose in the map
  for (const ScanOutput& output : run.scans) {
    const double t_s = SecondsOf(output.scan.stamp);
    const double variance = output.filter->nav.map_pose_cov.topLeftCorner<3, 3>().trace();
    if (t_s < 4.0) before = variance;
    if (t_s < 5.0) blind = variance;
    after = variance;
  }
  EXPECT_GT(blind, 4 * before);
  EXPECT_LT(after, 0.5 * blind);
}

TEST(Odometry, EmptySweepsAreCountedAndSurvived) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (!message.is_imu && (message.chunk.scan_seq == 3 || message.chunk.scan_seq == 40)) {
      message.chunk.points.clear();
    }
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_scans_empty, 2);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, MissingChunksMakeSmallerScans) {
  const Messages messages = Where(StaticStartDrive(), [](const Message& message) {
    const ScanChunk& chunk = message.chunk;
    return message.is_imu || chunk.scan_seq % 4 != 1 || chunk.chunk_index != chunk.scan_seq % 3;
  });
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_chunks_missing, 16);
  EXPECT_EQ(run.counters.num_scans, 65);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BadChunksAreCountedAndLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (message.is_imu || message.chunk.scan_seq % 10 != 5) continue;
    if (message.chunk.chunk_index == 1) message.chunk.chunk_index = 77;
    if (message.chunk.chunk_index == 2) message.chunk.points[0].t_offset_ns = 4'000'000'000u;
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_chunks_bad, 12);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

// --- faults of streams

TEST(Odometry, GapOfTheImuIsBridged) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 4.0, 4.6), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_gaps, 1);
  EXPECT_EQ(run.counters.num_restarts, 0);
  const auto first = static_cast<std::size_t>(run.scans.front().scan.scan_seq);
  EXPECT_EQ(run.scans.size() + first, 65u) << "no scan is lost";
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, GapOfTheLidarIsBridged) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 4.6), test::DriveRig());
  EXPECT_EQ(run.counters.num_scan_gaps, 1);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.1);
  EXPECT_TRUE(run.scans.back().scan.fused);
}

TEST(Odometry, GapOfTheLidarAloneIsBridged) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 4.6), LidarOnly());
  EXPECT_EQ(run.counters.num_scan_gaps, 1);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
  EXPECT_TRUE(run.scans.back().scan.fused);
}

TEST(Odometry, LongGapOfTheImuKeepsTheMap) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 3.5, 5.0), test::DriveRig());
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.15);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, ImuDyingForGoodLeavesTheLidarTracking) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 3.5, 100.0), test::DriveRig());
  EXPECT_GT(run.counters.num_scans_without_imu, 5);
  EXPECT_EQ(run.scans.back().scan.scan_seq, 64);
  EXPECT_TRUE(run.scans.back().scan.fused);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
  ExpectStampsIncrease(run);
}

TEST(Odometry, LidarDyingForGoodLeavesTheImuPublishing) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 100.0), test::DriveRig());
  EXPECT_NEAR(SecondsOf(run.navs.back().stamp), kEnd_s, 1e-6);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BothClocksSteppedTogetherGoOnWithTheMap) {
  for (const double shift_s : {100.0, -100.0}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s);
    const RunResult run = RunOdometry(messages, test::DriveRig());
    EXPECT_EQ(run.counters.num_restarts, 1) << shift_s;
    // Scans before the step, and those after it in the time they were sent.
    std::vector<ScanOutput> after;
    for (const ScanOutput& output : run.scans) {
      if (std::abs(SecondsOf(output.scan.stamp) - shift_s) < 20.0) after.push_back(output);
    }
    EXPECT_GT(after.size(), 20u) << shift_s;
    EXPECT_TRUE(after.back().scan.fused) << shift_s;
    EXPECT_LT(ErrorAgainst(RestThenDrive(), after, 4.0, shift_s).max_m, 0.15) << shift_s;
  }
}

TEST(Odometry, ClocksSteppedForthAndBackGoOn) {
  Messages messages = WithClockStep(StaticStartDrive(), 3.0, 50.0);
  messages = WithClockStep(messages, 4.5, -50.0);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_restarts, 2);
  EXPECT_TRUE(run.scans.back().scan.fused);
  EXPECT_NEAR(SecondsOf(run.scans.back().scan.stamp), kEnd_s, 0.01);
}

TEST(Odometry, OneWildStampOfEitherSensorIsSurvived) {
  for (const double shift_s : {3600.0, -3600.0, 0.8, -0.8}) {
    for (const bool of_imu : {true, false}) {
      Messages messages = StaticStartDrive();
      for (Message& message : messages) {
        if (message.is_imu != of_imu || !IsBetween(message, 4.0, 4.01 + (of_imu ? 0.0 : 0.09))) {
          continue;
        }
        const Duration shift = Duration::FromSeconds(shift_s);
        message.sample.stamp = message.sample.stamp + shift;
        message.chunk.stamp = message.chunk.stamp + shift;
      }
      const RunResult run = RunOdometry(messages, test::DriveRig());
      const std::string what = (of_imu ? "IMU by " : "lidar by ") + std::to_string(shift_s);
      EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans, -1e9).end_m, 0.1) << what;
      EXPECT_TRUE(run.scans.back().scan.fused) << what;
      EXPECT_EQ(run.scans.back().scan.scan_seq, 64) << what;
    }
  }
}

TEST(Odometry, WildStampsOfTheLidarAloneAreSurvived) {
  for (const double shift_s : {1e6, 30.0, -30.0}) {
    Messages messages = StaticStartDrive();
    for (Message& message : messages) {
      if (message.is_imu || message.chunk.scan_seq != 40) continue;
      message.chunk.stamp = message.chunk.stamp + Duration::FromSeconds(shift_s);
    }
    const RunResult run = RunOdometry(messages, LidarOnly());
    EXPECT_TRUE(run.scans.back().scan.fused) << shift_s;
    EXPECT_GT(NumFused(run), 50) << shift_s;
  }
}

TEST(Odometry, ClockOfTheLidarAloneSetBackGoesOn) {
  for (const double shift_s : {-100.0, 100.0}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s);
    const RunResult run = RunOdometry(messages, LidarOnly());
    EXPECT_TRUE(run.scans.back().scan.fused) << shift_s;
    EXPECT_GT(NumFused(run), 50) << shift_s;
  }
}

TEST(Odometry, PublishedStampsNeverGoBack) {
  const Messages& drive = StaticStartDrive();
  Messages late = drive;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> delay_s(0.0, 0.2);
  for (Message& message : late) {
    message.arrival = message.arrival + Duration::FromSeconds(delay_s(random));
  }
  ExpectStampsIncrease(RunOdometry(SortedByArrival(late), test::DriveRig()));
  ExpectStampsIncrease(RunOdometry(SortedByArrival(late), test::DriveRig(), 20));
  ExpectStampsIncrease(RunOdometry(drive, test::DriveRig(), 20));
  ExpectStampsIncrease(RunOdometry(WithClockStep(drive, 3.5, 10.0), test::DriveRig()));
}

// --- overload

TEST(Odometry, OverloadDropsTheOldestScansAndCountsThem) {
  const Options options = test::DriveRig();
  Odometry odometry(options);
  MatchSide matching(options);
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

// --- ring lock (docs/filter.md): a map filled by a parked sensor shows single scan rings

TEST(Odometry, ParkedStartDoesNotHoldTheVehicleBack) {
  DriveOptions drive;
  drive.motion = test::WindingDrive(4.0);
  drive.to_s = 8.5;
  const RunResult run = RunOdometry(SimulateDrive(test::Street(), drive), test::DriveRig());
  EXPECT_LT(ErrorAgainst(drive.motion, run.scans).max_m, 0.05);
  EXPECT_EQ(run.counters.num_gated, 0);
}

TEST(Odometry, ParkedStartInACorridorDoesNotHoldTheVehicleBack) {
  DriveOptions drive;
  drive.motion = test::StraightDrive(4.0);
  drive.to_s = 7.5;
  const RunResult run = RunOdometry(SimulateDrive(test::Corridor(), drive), test::DriveRig());
  // Nothing holds the vehicle along the corridor but the IMU: centimetres a second squared.
  EXPECT_LT(ErrorAgainst(drive.motion, run.scans).max_m, 0.4);
}

}  // namespace
}  // namespace lio
