// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lio/base/counters_fields.hpp"
#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr Timestamp kRowStamp{1'700'000'000'000'000'007};

std::vector<std::string> LinesOfFile(const std::filesystem::path& file) {
  std::istringstream text(test::ReadText(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

ScanOutput Scan(Timestamp stamp) {
  ScanOutput output;
  output.filter.emplace();
  output.filter->nav.stamp = stamp;
  output.filter->nav.T_map_imu = {Quaternion(0.5, -0.5, 0.5, 0.5), Vector3(1, -2, 3.25)};
  output.filter->map_as_world_cov(0, 1) = 0.125;
  output.filter->nav.T_world_imu.translation = Vector3(1, -2, 3.5);
  output.filter->nav.pose_cov(0, 1) = 0.0625;
  output.scan.stamp = stamp;
  output.scan.status = MatchStatus::kEmptyMap;
  return output;
}

NavOutput ImuRate(Timestamp stamp) {
  NavOutput nav;
  nav.stamp = stamp;
  nav.source = OdometrySource::kImuPropagated;
  return nav;
}

class RunWriterTest : public ::testing::Test {
 protected:
  // Writes a run of one scan.
  void WriteRun(const ScanOutput& scan, const Options& options = {}) {
    RunWriter writer(out_, options);
    writer.Write(scan);
    writer.Finish({});
  }
  nlohmann::json Stats() { return nlohmann::json::parse(test::ReadText(out_ / "stats.json")); }

  test::TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "deep" / "out";
};

TEST_F(RunWriterTest, TrajectoryRowsAreTumWithNineDecimals) {
  WriteRun(Scan(kRowStamp));
  EXPECT_THAT(LinesOfFile(out_ / "trajectory.tum"),
              ElementsAre("1700000000.000000007 1.000000000 -2.000000000 3.250000000 "
                          "-0.500000000 0.500000000 0.500000000 0.500000000"));
}

// The logs count from zero; their stamps are shifted back.
TEST_F(RunWriterTest, StampsBeforeTheEpochAreRowsToo) {
  WriteRun(Scan(Timestamp{-40'000'000}));
  EXPECT_THAT(LinesOfFile(out_ / "trajectory.tum"),
              ElementsAre(testing::StartsWith("-0.040000000 1.000000000 ")));
}

TEST_F(RunWriterTest, CovarianceHasAHeaderAndTheTrajectorysStamps) {
  WriteRun(Scan(kRowStamp));
  const auto lines = LinesOfFile(out_ / "covariance.csv");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], StartsWith("t_s,cov_x_x,cov_x_y,"));
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), 36);
  EXPECT_EQ(std::count(lines[1].begin(), lines[1].end(), ','), 36);
  EXPECT_THAT(lines[1], StartsWith("1700000000.000000007,0.000000000000e+00,1.250000000000e-01,"));
}

TEST_F(RunWriterTest, TheWorldHasATrajectoryAndCovariancesOfItsOwn) {
  WriteRun(Scan(kRowStamp));
  EXPECT_THAT(LinesOfFile(out_ / "trajectory_world.tum"),
              ElementsAre("1700000000.000000007 1.000000000 -2.000000000 3.500000000 "
                          "0.000000000 0.000000000 0.000000000 1.000000000"));
  const auto lines = LinesOfFile(out_ / "covariance_world.csv");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], LinesOfFile(out_ / "covariance.csv")[0]);
  EXPECT_THAT(lines[1], StartsWith("1700000000.000000007,0.000000000000e+00,6.250000000000e-02,"));
}

TEST_F(RunWriterTest, TheBaseHasATrajectoryOfItsOwnWhereTheRigNamesOne) {
  Options options;
  options.rig.T_base_imu = Pose{Quaternion::Identity(), Vector3(1, 0, 0)};
  ScanOutput scan = Scan(kRowStamp);
  scan.filter->nav.base.emplace().T_map_base.translation = Vector3(0, -2, 3.25);
  WriteRun(scan, options);
  EXPECT_THAT(LinesOfFile(out_ / "trajectory_base.tum"),
              ElementsAre("1700000000.000000007 0.000000000 -2.000000000 3.250000000 "
                          "0.000000000 0.000000000 0.000000000 1.000000000"));
  RunWriter(out_, Options{}).Finish({});
  EXPECT_FALSE(std::filesystem::exists(out_ / "trajectory_base.tum")) << "of an earlier run";
}

TEST_F(RunWriterTest, ScansBeforeTheStartAreRegisteredButNotInTheTrajectory) {
  ScanOutput waiting = Scan(kRowStamp);
  waiting.filter.reset();
  WriteRun(waiting);
  EXPECT_EQ(LinesOfFile(out_ / "trajectory.tum").size(), 0u);
  const auto rows = LinesOfFile(out_ / "registration.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(std::count(rows[0].begin(), rows[0].end(), ','),
            std::count(rows[1].begin(), rows[1].end(), ','));
  EXPECT_THAT(rows[1], HasSubstr(",empty_map,0,"));
}

TEST_F(RunWriterTest, ARowSaysHowManyMatchesItTookAndAtWhichLevels) {
  ScanOutput scan = Scan(kRowStamp);
  scan.scan.num_matches = 3;
  scan.scan.num_coarse_matches = 13;
  scan.scan.num_matched_at = {0, 700, 30, 5, 2, 1};
  WriteRun(scan);
  const auto rows = LinesOfFile(out_ / "registration.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_THAT(
      rows[0],
      HasSubstr(
          ",information_eigenvalue_5,matched_level_0,matched_level_1,matched_level_2,"
          "matched_level_3,matched_level_4,matched_level_5,matches,coarse_matches,decode_ms,"));
  EXPECT_THAT(rows[1], HasSubstr(",0,700,30,5,2,1,3,13,0.000000,"));
}

TEST_F(RunWriterTest, RowsThatAreNotLaterAreCountedNotWritten) {
  RunWriter writer(out_, Options{});
  for (const Timestamp stamp :
       {kRowStamp, kRowStamp, kRowStamp - Duration{5}, kRowStamp + Duration{1}}) {
    writer.Write(Scan(stamp));
    writer.Write(ImuRate(stamp));
  }
  writer.Finish({});
  EXPECT_EQ(LinesOfFile(out_ / "trajectory.tum").size(), 2u);
  EXPECT_EQ(LinesOfFile(out_ / "covariance.csv").size(), 3u);
  EXPECT_EQ(LinesOfFile(out_ / "trajectory_imu_rate.tum").size(), 2u);
  EXPECT_EQ(Stats()["num_rows_not_later"], 4);
}

// The clock goes back by five seconds and comes to the old time again.
TEST_F(RunWriterTest, RowsAfterAClockThatWentBackStandInASegmentBesides) {
  RunWriter writer(out_, Options{});
  for (const std::int64_t at_s : {0, 1, -4, -3, 2}) {
    const Timestamp stamp = kRowStamp + Duration{1'000'000'000 * at_s};
    writer.Write(ImuRate(stamp));
    writer.Write(Scan(stamp));
  }
  ScanOutput waiting = Scan(kRowStamp - Duration{3600'000'000'000});
  waiting.filter.reset();
  writer.Write(waiting);
  writer.Finish({});
  const auto num_rows = [&](const std::filesystem::path& folder, const char* file) {
    return LinesOfFile(out_ / folder / file).size();
  };
  for (const char* folder : {"", "segment_2"}) {  // 0, 1, 2 and -4, -3, 2
    EXPECT_EQ(num_rows(folder, "trajectory.tum"), 3u) << folder;
    EXPECT_EQ(num_rows(folder, "trajectory_imu_rate.tum"), 3u) << folder;
    EXPECT_EQ(num_rows(folder, "covariance_world.csv"), 4u) << folder;
  }
  EXPECT_EQ(num_rows("", "registration.csv"), 7u) << "every scan";
  std::vector<std::string> segments;
  for (const std::string& row : LinesOfFile(out_ / "states.csv")) {
    segments.push_back(row.substr(row.find(',') + 1, 2));
  }
  EXPECT_THAT(segments, ElementsAre("se", "1,", "1,", "2,", "2,", "2,"))
      << "every scan with a pose";
  EXPECT_EQ(num_rows("segment_2", "registration.csv"), 4u);
  EXPECT_EQ(num_rows("segment_3", "trajectory.tum"), 0u);
  EXPECT_EQ(num_rows("segment_3", "registration.csv"), 2u) << "a scan without a pose";
  EXPECT_EQ(Stats()["num_rows_not_later"], 4);
  EXPECT_EQ(Stats()["num_segments"], 3);
  RunWriter(out_, Options{}).Finish({});
  EXPECT_FALSE(std::filesystem::exists(out_ / "segment_2")) << "of an earlier run";
  EXPECT_FALSE(std::filesystem::exists(out_ / "segment_3"));
}

TEST_F(RunWriterTest, StatsHoldCountsSpeedAndStageTimes) {
  RunWriter writer(out_, Options{});
  for (int i = 1; i <= 100; ++i) {
    ScanOutput scan = Scan(kRowStamp + Duration{i});
    scan.scan.stage_ns[static_cast<std::size_t>(Stage::kMatch)] = i * 1'000'000;
    writer.Write(scan);
  }
  RunStats stats;
  stats.counters.num_scans = 100;
  stats.counters.num_gated = 3;
  stats.input.num_refused[static_cast<std::size_t>(DecodeStatus::kWrongType)] = 2;
  stats.num_skipped_bytes = 17;
  stats.extra = {{"num_dropped_kernel", 5}};
  stats.log_duration_s = 10.0;
  stats.wall_s = 0.5;
  writer.Finish(stats);
  const auto json = Stats();
  EXPECT_EQ(json["num_scans"], 100);
  EXPECT_EQ(json["num_gated"], 3);
  EXPECT_EQ(json["num_messages_wrong_type"], 2);
  EXPECT_EQ(json["num_skipped_bytes"], 17);
  EXPECT_EQ(json["num_dropped_kernel"], 5);
  EXPECT_EQ(json["realtime_factor"], 20.0);
  EXPECT_GT(json["rss_peak_mb"], 1.0);
  EXPECT_NEAR(json["stage_ms"]["match"]["median"], 50.5, 0.6);
  EXPECT_EQ(json["stage_ms"]["match"]["p99"], 99.0);
  EXPECT_EQ(json["stage_ms"]["match"]["max"], 100.0);
  EXPECT_EQ(json["stage_ms"]["total"]["max"], 0.0);
}

TEST_F(RunWriterTest, EveryCountOfTheEstimatorIsInTheStats) {
  RunWriter writer(out_, Options{});
  // Each gets a value of its own.
  std::array<std::int64_t, kCounterFields.size()> values{};
  Counters counters;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = 1'000'000 + static_cast<int>(i);
    counters.*kCounterFields[i].count = values[i];
  }
  RunStats stats;
  stats.counters = counters;
  writer.Finish(stats);
  const std::string text = test::ReadText(out_ / "stats.json");
  for (const std::int64_t value : values) EXPECT_THAT(text, HasSubstr(std::to_string(value)));
}

TEST_F(RunWriterTest, EachCountHasItsNameInTheStats) {
  RunWriter writer(out_, Options{});
  RunStats stats;
  std::int64_t value = 1'000'000;
  for (const CounterField& field : kCounterFields) stats.counters.*field.count = ++value;
  writer.Finish(stats);
  const auto json = Stats();
  for (const CounterField& field : kCounterFields) {
    EXPECT_EQ(json[std::string(field.name)], stats.counters.*field.count) << field.name;
  }
}

TEST_F(RunWriterTest, ALongRunsStageTimesAreRightToOnePercent) {
  RunWriter writer(out_, Options{});
  ScanOutput scan = Scan(kRowStamp);
  scan.filter.reset();
  constexpr int kNumScans = 8'000;
  for (int i = 1; i <= kNumScans; ++i) {
    // 7919 is prime: every value of 1 .. kNumScans once, in mixed order.
    scan.scan.stage_ns[static_cast<std::size_t>(Stage::kMatch)] =
        (std::int64_t{i} * 7919 % kNumScans + 1) * 1'000;
    writer.Write(scan);
  }
  writer.Finish({});
  const auto match = Stats()["stage_ms"]["match"];
  EXPECT_NEAR(match["median"].get<double>(), 4.0, 0.04);
  EXPECT_NEAR(match["p99"].get<double>(), 7.92, 0.079);
  EXPECT_EQ(match["max"], 8.0);
}

TEST_F(RunWriterTest, WithoutScansStageTimesAreNull) {
  RunWriter writer(out_, Options{});
  writer.Finish({});
  EXPECT_TRUE(Stats()["stage_ms"]["total"]["median"].is_null());
}

TEST_F(RunWriterTest, StatsHaveTheNoiseOfTheImuWhereItIsKnown) {
  ScanOutput scan = Scan(kRowStamp);
  scan.filter->imu_noise.accel = 9.0;
  WriteRun(scan);
  EXPECT_EQ(Stats()["imu_noise_per_rig"]["accel"]["median"], 9.0);
  EXPECT_TRUE(Stats()["imu_noise_per_rig"]["gyro"]["median"].is_null());
}

TEST_F(RunWriterTest, TheMapIsTurnedAsTheLevelPathIs) {
  ScanOutput scan = Scan(kRowStamp);
  scan.filter->g_world_mps2 = Vector3(0, 0, -9.8);
  scan.filter->nav.T_map_imu.rotation = ExpSo3(Vector3(M_PI / 2, 0, 0));  // map's z is along -y
  RunWriter writer(out_, Options{});
  writer.Write(scan);
  writer.WriteMap(std::vector<Eigen::Vector3f>{{1, 2, 3}}, MapFormat::kPly);
  writer.Finish({});
  EXPECT_TRUE(std::filesystem::exists(out_ / "trajectory_level.tum"));
  EXPECT_FALSE(std::filesystem::exists(out_ / "map.pcd"));
  const std::string map = test::ReadText(out_ / "map.ply");
  EXPECT_THAT(map, HasSubstr("element vertex 1"));
  Eigen::Vector3f point;
  std::memcpy(point.data(), map.data() + map.size() - sizeof(point), sizeof(point));
  EXPECT_LT((point - Eigen::Vector3f(1, 3, -2)).norm(), 1e-5) << point.transpose();
}

TEST_F(RunWriterTest, OptionsAreThoseThatWereUsed) {
  Options options;
  options.ndt.voxel_m = 1.75;
  options.pipeline.num_threads = 3;
  RunWriter writer(out_, options);
  const std::string written = test::ReadText(out_ / "options.yaml");
  EXPECT_THAT(written, HasSubstr("voxel_m: 1.75 "));
  EXPECT_THAT(written, Not(HasSubstr("num_threads"))) << "changes no result";
}

TEST_F(RunWriterTest, StatesAndNoticesAreTablesOfTheirOwn) {
  RunWriter writer(out_, Options{});
  ScanOutput distrusted = Scan(kRowStamp);
  distrusted.trust = Trust::kNo;
  writer.Write(distrusted);
  writer.Write(Scan(kRowStamp + Duration{1}));
  writer.Write(Notice{kRowStamp, Notice::Severity::kWarning, "look out"});
  writer.Finish({});
  const auto states = LinesOfFile(out_ / "states.csv");
  ASSERT_EQ(states.size(), 3u);
  EXPECT_THAT(states[1], StartsWith("1700000000.000000007,1,0,2,"));
  EXPECT_THAT(states[2], StartsWith("1700000000.000000008,1,0,0,"));
  EXPECT_THAT(LinesOfFile(out_ / "notices.tsv"),
              ElementsAre("t_s\tseverity\ttext", "1700000000.000000007\twarning\tlook out"));
}

TEST_F(RunWriterTest, EarlierRunsAreOverwritten) {
  {
    RunWriter writer(out_, Options{});
    writer.Write(Scan(kRowStamp));
    writer.WriteMap(std::vector<Eigen::Vector3f>{{1, 2, 3}});
    writer.Finish({});
  }
  RunWriter writer(out_, Options{});
  writer.Finish({});
  EXPECT_EQ(LinesOfFile(out_ / "trajectory.tum").size(), 0u);
  EXPECT_FALSE(std::filesystem::exists(out_ / "map.pcd"));
}

TEST_F(RunWriterTest, WhatCannotBeWrittenIsNamed) {
  const auto file = folder_.Write("file", "");
  EXPECT_THROW(RunWriter(file / "out", Options{}), std::runtime_error);
}

TEST_F(RunWriterTest, RowsOfAllFilesAreThereAfterAHundredOfThemOrAFlush) {
  RunWriter writer(out_, Options{});
  for (int i = 1; i <= 99; ++i) writer.Write(Scan(Timestamp{i}));
  EXPECT_EQ(LinesOfFile(out_ / "trajectory.tum").size(), 0u);
  writer.Write(Scan(Timestamp{100}));
  for (const char* name : {"trajectory.tum", "trajectory_world.tum"}) {
    EXPECT_EQ(LinesOfFile(out_ / name).size(), 100u) << name;
  }
  for (const char* name : {"covariance.csv", "states.csv", "registration.csv"}) {
    EXPECT_EQ(LinesOfFile(out_ / name).size(), 101u) << name;
  }
  writer.Write(Scan(Timestamp{101}));
  writer.Flush();
  EXPECT_EQ(LinesOfFile(out_ / "trajectory.tum").size(), 101u);
  EXPECT_EQ(LinesOfFile(out_ / "registration.csv").size(), 102u);
}

TEST_F(RunWriterTest, AFullDiskIsAFailureThatFinishThrows) {
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  RunWriter writer(out_, Options{});
  EXPECT_FALSE(writer.failure());
  const rlimit small{.rlim_cur = 40'000, .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  for (int i = 1; i <= 1000; ++i) writer.Write(Scan(Timestamp{i}));
  ASSERT_TRUE(writer.failure());
  EXPECT_THAT(*writer.failure(), HasSubstr("covariance.csv in full: File too large"));
  EXPECT_THROW(writer.Finish({}), WriteError);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_FALSE(Stats().empty());
  EXPECT_EQ(LinesOfFile(out_ / "states.csv").size(),
            LinesOfFile(out_ / "trajectory_world.tum").size() + 1);
  EXPECT_TRUE(test::ReadText(out_ / "covariance.csv").ends_with('\n'));
}

TEST_F(RunWriterTest, BeamsAreWrittenUnlessNothingIsTrusted) {
  RunStats stats;
  stats.verdict.trust = Trust::kYes;
  stats.beams = LidarBeams{{0.01}, {0.004}, {0}, {1e-4}, {0}, {1e-4}, {0, 0}, {1e-5, 1e-5}};
  RunWriter(out_, Options{}).Finish(stats);
  EXPECT_THAT(test::ReadText(out_ / "beams.yaml"), HasSubstr("range_m: [0.01]"));
  EXPECT_EQ(Stats()["beam_errors"]["range_m"]["rms"], 0.01);
  EXPECT_EQ(Stats()["beam_errors"]["elevation_rad"]["std"], 1e-4);
  stats.verdict.trust = Trust::kNo;
  RunWriter(out_, Options{}).Finish(stats);
  EXPECT_FALSE(std::filesystem::exists(out_ / "beams.yaml"));
}

}  // namespace
}  // namespace lio
