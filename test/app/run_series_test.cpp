// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/run_series.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

RunStats Counted(std::int64_t num_imu, std::int64_t num_failed) {
  RunStats stats;
  stats.counters.num_imu = num_imu;
  stats.input.num_imu_missing = num_imu / 10;
  stats.extra = {{"num_publish_failed", num_failed}};
  stats.wall_s = static_cast<double>(num_imu);
  return stats;
}

nlohmann::json StatsIn(const fs::path& folder) {
  return nlohmann::json::parse(test::ReadText(folder / "stats.json"));
}

TEST(RunSeries, EachFolderIsCompleteAndCountsItsOwnTime) {
  const test::TempDir temp;
  const fs::path out = temp.path() / "out";
  RunSeries files({out, out}, Options{}, StartIn::kNewMap);
  EXPECT_EQ(files.folder(), out);
  files.Renew(Counted(100, 3));
  EXPECT_EQ(files.folder(), temp.path() / "out-2");
  ASSERT_NE(files.writer(), nullptr);
  files.Renew(Counted(250, 3));
  files.Finish(Counted(260, 4));
  EXPECT_FALSE(files.failure());
  const std::pair<const char*, int> cases[] = {{"out", 100}, {"out-2", 150}, {"out-3", 10}};
  for (const auto& [name, num_imu] : cases) {
    const auto stats = StatsIn(temp.path() / name);
    EXPECT_EQ(stats["num_imu"], num_imu) << name;
    EXPECT_EQ(stats["num_imu_missing"], num_imu / 10) << name;
    EXPECT_EQ(stats["wall_s"], num_imu) << name;
    EXPECT_TRUE(fs::exists(temp.path() / name / "verdict.json")) << name;
  }
  EXPECT_EQ(StatsIn(temp.path() / "out-2")["num_publish_failed"], 0);
  EXPECT_EQ(StatsIn(out)["num_publish_failed"], 3);
}

TEST(RunSeries, EarlierRunsAreKeptWhateverTheFirstFolderIs) {
  const test::TempDir temp;
  temp.Write("out-2/options.yaml", "of another run");
  RunSeries files({temp.path() / "out-3", temp.path() / "out"}, Options{}, StartIn::kNewMap);
  files.Renew({});
  EXPECT_EQ(files.folder(), temp.path() / "out");
  files.Renew({});
  EXPECT_EQ(files.folder(), temp.path() / "out-4");
  EXPECT_EQ(test::ReadText(temp.path() / "out-2/options.yaml"), "of another run");
}

TEST(RunSeries, AFolderThatCannotBeMadeIsAFailureAndTheOldOneIsComplete) {
  const test::TempDir temp;
  const fs::path file = temp.Write("file", "");
  RunSeries files({temp.path() / "out", file / "out"}, Options{}, StartIn::kNewMap);
  files.Renew(Counted(1, 0));
  EXPECT_EQ(files.writer(), nullptr);
  ASSERT_TRUE(files.failure());
  EXPECT_NE(files.failure()->find(file.string()), std::string::npos);
  EXPECT_TRUE(fs::exists(temp.path() / "out" / "verdict.json"));
}

}  // namespace
}  // namespace lio
