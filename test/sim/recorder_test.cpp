// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "lio/io/event_log.hpp"
#include "lio/io/lcm_codec.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/temp_dir.hpp"

namespace lio::sim {
namespace {

RecordOptions Options(const std::string& lidar) {
  RecordOptions options;
  options.lidar = LoadLidarModel(lidar);
  options.imu = LoadImuModel("xsens_mti10");
  options.seed = 11;
  return options;
}

Scenario ShortHall(double duration_s) {
  ScenarioOptions options;
  options.seed = 11;
  options.duration_s = duration_s;
  return MakeScenario("hall", options);
}

struct DecodedLog {
  std::vector<ImuSample> imu;
  std::vector<ScanChunk> chunks;
  std::int64_t num_back_in_time = 0;

  explicit DecodedLog(const std::filesystem::path& path) {
    EventLogReader reader(path);
    LogEvent event;
    std::int64_t last = 0;
    while (reader.Next(event)) {
      num_back_in_time += event.utime < last ? 1 : 0;
      last = event.utime;
      if (event.channel == "LIO_IMU") {
        std::int32_t seq = 0;
        EXPECT_EQ(DecodeImu(event.data, imu.emplace_back(), seq), DecodeStatus::kOk);
        EXPECT_EQ(seq, static_cast<std::int32_t>(imu.size()) - 1);
        EXPECT_NEAR(static_cast<double>(event.utime - imu.back().stamp.Microseconds()), 300.0, 1.0);
      } else {
        EXPECT_EQ(event.channel, "LIO_SCAN");
        EXPECT_EQ(DecodeChunk(event.data, chunks.emplace_back()), DecodeStatus::kOk);
        const ScanChunk& chunk = chunks.back();
        const Timestamp last_point = chunk.stamp + Duration{chunk.points.back().t_offset_ns};
        EXPECT_NEAR(static_cast<double>(event.utime - last_point.Microseconds()), 500.0, 2.0);
      }
    }
    EXPECT_EQ(reader.skipped_bytes(), 0);
  }
};

TEST(Record, SameSeedGivesTheSameBytesOnOneAndOnTwoThreads) {
  const Scenario scenario = ShortHall(1.5);
  const test::TempDir dir;
  RecordOptions options = Options("vlp16");
  options.faults = {ParseFault("drop:ratio=0.1"), ParseFault("nan"),
                    ParseFault("dust:start=0.5,duration=0.5")};
  for (const int threads : {1, 2}) {
    options.num_threads = threads;
    Record(scenario, options, dir.path() / std::to_string(threads), {});
  }
  const Scenario again = ShortHall(1.5);
  Record(again, options, dir.path() / "again", {});
  for (const char* file : {"log.lcm", "truth.tum", "truth_states.csv", "config.yaml"}) {
    const std::string one = test::ReadText(dir.path() / "1" / file);
    EXPECT_FALSE(one.empty()) << file;
    EXPECT_TRUE(one == test::ReadText(dir.path() / "2" / file)) << file;
    EXPECT_TRUE(one == test::ReadText(dir.path() / "again" / file)) << file;
  }
}

TEST(Record, ScansOfAnotherLogOfTheDriveGiveTheSameLogAgain) {
  const Scenario scenario = ShortHall(1.5);
  const test::TempDir dir;
  RecordOptions options = Options("vlp16");
  Record(scenario, options, dir.path() / "cast", {});
  options.scans = dir.path() / "cast" / "log.lcm";
  Record(scenario, options, dir.path() / "copied", {});
  EXPECT_TRUE(test::ReadText(dir.path() / "cast" / "log.lcm") ==
              test::ReadText(dir.path() / "copied" / "log.lcm"));
}

TEST(Record, LogHoldsEveryMessageOnceInOrderAtItsTime) {
  const Scenario scenario = ShortHall(2.0);
  const test::TempDir dir;
  const RecordStats stats = Record(scenario, Options("hdl32e"), dir.path(), {});
  const DecodedLog log(dir.path() / "log.lcm");
  EXPECT_EQ(log.num_back_in_time, 0);
  EXPECT_EQ(log.imu.size(), 201u);
  EXPECT_EQ(static_cast<std::int64_t>(log.chunks.size()), stats.num_chunks);
  EXPECT_GE(stats.num_sweeps, 19);
  std::int64_t num_points = 0;
  for (std::size_t i = 0; i < log.chunks.size(); ++i) {
    const ScanChunk& chunk = log.chunks[i];
    num_points += static_cast<std::int64_t>(chunk.points.size());
    EXPECT_LE(chunk.points.size(), static_cast<std::size_t>(kMaxChunkPoints));
    if (i == 0) continue;
    const ScanChunk& before = log.chunks[i - 1];
    if (chunk.chunk_index == 0) {
      EXPECT_EQ(chunk.scan_seq, before.scan_seq + 1);
      EXPECT_EQ(before.chunk_index + 1, before.chunk_count);
    } else {
      EXPECT_EQ(chunk.scan_seq, before.scan_seq);
      EXPECT_EQ(chunk.chunk_index, before.chunk_index + 1);
      EXPECT_GT(chunk.stamp, before.stamp);
    }
  }
  EXPECT_EQ(num_points, stats.num_points);
}

// This tests the whole chain through the files alone: points of the log, at the truth's poses of
// their own times, show the end wall of the hall as flat as the range noise allows.
TEST(Record, LogAndTruthTogetherLeaveAWallFlatToTheRangeNoise) {
  ScenarioOptions scenario_options;
  scenario_options.duration_s = 9.0;
  const Scenario scenario = MakeScenario("hall", scenario_options);
  const test::TempDir dir;
  RecordOptions options = Options("vlp16");
  options.imu.rate_hz = 1000.0;  // straight lines between the truth's poses are exact at this rate
  Record(scenario, options, dir.path(), {});
  const DecodedLog log(dir.path() / "log.lcm");
  const StampedPoses truth = ReadTrajectory(dir.path() / "truth.tum").poses;
  const LoadResult config = LoadOptions({dir.path() / "config.yaml"}, {});
  ASSERT_TRUE(config.faults.empty()) << config.faults.front();
  double sum = 0.0;
  double sum_sq = 0.0;
  int num = 0;
  for (const ScanChunk& chunk : log.chunks) {
    for (const LidarPoint& point : chunk.points) {
      const double at =
          1e3 * SecondsBetween(truth.front().stamp, chunk.stamp + Duration{point.t_offset_ns});
      const auto k = std::min(static_cast<std::size_t>(at), truth.size() - 2);
      const Pose imu = Interpolate(truth[k].pose, truth[k + 1].pose, at - static_cast<double>(k));
      const Vector3 p =
          imu * (*config.options.rig.T_imu_lidar * Vector3(point.x_m, point.y_m, point.z_m));
      // Only the brick wall at x = 22 is used, above the doors and beside the hoop.
      if (std::abs(p.x() - 22.0) > 0.15 || p.z() < 3.7 || p.z() > 7.3 || std::abs(p.y()) < 2.0) {
        continue;
      }
      sum += p.x() - 22.0;
      sum_sq += (p.x() - 22.0) * (p.x() - 22.0);
      ++num;
    }
  }
  ASSERT_GT(num, 1000);
  const double mean = sum / num;
  EXPECT_NEAR(mean, 0.0, 2e-3);
  EXPECT_LT(std::sqrt(sum_sq / num - mean * mean), 1.2 * options.lidar.range_std_m);
}

TEST(Record, ConfigurationIsTakenAsItIsAndTellsTheRig) {
  const Scenario scenario = ShortHall(1.0);
  const test::TempDir dir;
  RecordOptions options = Options("os1_64");
  options.gravity_mps2 = 9.788;
  options.faults = {ParseFault("wrong_extrinsic:yaw_deg=5")};
  Record(scenario, options, dir.path(), {});
  const LoadResult config = LoadOptions({dir.path() / "config.yaml"}, {});
  ASSERT_TRUE(config.faults.empty()) << config.faults.front();
  const Rig& rig = config.options.rig;
  EXPECT_EQ(rig.lidar.model, "os1_64");
  EXPECT_EQ(rig.gravity_mps2, 9.788);
  EXPECT_NEAR(rig.imu.gyro_noise_density, options.imu.gyro.noise_density, 1e-9);
  ASSERT_TRUE(rig.T_imu_lidar);
  EXPECT_NEAR(rig.T_imu_lidar->rotation.angularDistance(scenario.T_imu_lidar.rotation),
              5.0 / 180.0 * 3.14159265, 1e-6);
}

TEST(Record, GyroAtTheEndOfItsRangeDoesNotShowTheMotorsOfTheCarrier) {
  Scenario scenario = ShortHall(5.0);
  scenario.shake_accel_mps2 = 1.0;
  scenario.shake_gyro_radps = 0.5;
  const test::TempDir dir;
  RecordOptions options = Options("vlp16");
  options.imu_effects.vibrates = true;
  const auto count_beyond = [&](const std::string& name) {
    Record(scenario, options, dir.path() / name, {});
    const DecodedLog log(dir.path() / name / "log.lcm");
    return std::count_if(log.imu.begin(), log.imu.end(), [](const ImuSample& sample) {
      return sample.w_imu_radps.lpNorm<Eigen::Infinity>() > 0.25;
    });
  };
  EXPECT_GT(count_beyond("whole"), 50);
  options.faults = {ParseFault("gyro_saturation:limit=0.25,start=0,duration=10")};
  EXPECT_EQ(count_beyond("clipped"), 0);
}

TEST(Record, TruthStatesAreTheDerivativesOfTheTruth) {
  const Scenario scenario = ShortHall(4.0);
  const test::TempDir dir;
  Record(scenario, Options("vlp16"), dir.path(), {});
  const StampedPoses truth = ReadTrajectory(dir.path() / "truth.tum").poses;
  std::ifstream file(dir.path() / "truth_states.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line.substr(0, 17), "t_s,vx_world_mps,");
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    ASSERT_EQ(rows.back().size(), 16u);
  }
  ASSERT_EQ(rows.size(), truth.size());
  for (std::size_t k = 1; k + 1 < rows.size(); k += 7) {
    const Vector3 difference =
        (truth[k + 1].pose.translation - truth[k - 1].pose.translation) / 0.02;
    const Vector3 velocity(rows[k][1], rows[k][2], rows[k][3]);
    EXPECT_LT((difference - velocity).norm(), 0.02) << "row " << k;  // jerk h^2 / 6
    const Vector3 turned =
        LogSo3(truth[k - 1].pose.rotation.conjugate() * truth[k + 1].pose.rotation) / 0.02;
    const Vector3 rate(rows[k][10], rows[k][11], rows[k][12]);
    EXPECT_LT((turned - rate).norm(), 0.05) << "row " << k;
  }
}

TEST(Record, UnwritableFolderIsAnError) {
  const Scenario scenario = ShortHall(0.5);
  const test::TempDir dir;
  const auto file = dir.Write("taken", "");
  EXPECT_THROW(Record(scenario, Options("vlp16"), file, {}), std::exception);
}

// Prints a figure for people; machines differ, so the test asserts nothing about speed.
TEST(Record, PrintsItsRayRate) {
  ScenarioOptions options;
  options.duration_s = 2.0;
  const Scenario scenario = MakeScenario("street", options);
  const Scene scene(scenario.world);
  LidarSetup setup;
  setup.model = LoadLidarModel("hdl32e");
  setup.T_imu_lidar = scenario.T_imu_lidar;
  const LidarSimulator lidar(setup, scene, *scenario.trajectory);
  const auto start = std::chrono::steady_clock::now();
  std::int64_t num_rays = 0;
  for (std::int64_t i = 0; i < 5; ++i) num_rays += lidar.Sweep(i).num_rays;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("street, hdl32e, one thread: %.2f M rays/s\n",
              1e-6 * static_cast<double>(num_rays) / seconds);
  EXPECT_GT(num_rays, 5 * 69000);
}

}  // namespace
}  // namespace lio::sim
