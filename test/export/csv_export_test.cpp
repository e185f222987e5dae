// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "export/recorded_log.hpp"
#include "lio/export/export_log.hpp"

namespace lio {
namespace {

std::vector<std::string> Lines(const std::filesystem::path& file) {
  std::istringstream text(test::ReadText(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(CsvExport, EachKindHasATableOfItsColumns) {
  const test::TempDir folder;
  const auto tables = folder.path() / "tables";
  ExportCsv(test::RecordedLog(folder), tables, {});
  for (const char* name : {"odometry", "state", "registration", "status"}) {
    const auto lines = Lines(tables / (std::string(name) + ".csv"));
    ASSERT_GE(lines.size(), 2U) << name;
    const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
    for (const std::string& line : lines) {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << name << ": " << line;
    }
  }
  EXPECT_EQ(Lines(tables / "odometry.csv").size(), 1U + test::kNumScans);
  EXPECT_EQ(Lines(tables / "status.csv").size(), 1U + 6U);
  EXPECT_FALSE(std::filesystem::exists(tables / "odometry_imu.csv"));
}

TEST(CsvExport, NumbersComeBackAsTheyWere) {
  const test::TempDir folder;
  ExportCsv(test::RecordedLog(folder), folder.path() / "tables", {});
  const auto rows = Lines(folder.path() / "tables" / "state.csv");
  EXPECT_THAT(rows[3], ::testing::StartsWith("1700000000200000000,1700000000205000000,0,5,0,"
                                             "0.001,0.002,0.003,"));
  EXPECT_THAT(rows[3], ::testing::EndsWith(",5.5,6"));
}

}  // namespace
}  // namespace lio
