// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "lio/report/run_report.hpp"
#include "report/run_folder.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ReportDataTest = test::RunFolder;

TEST_F(ReportDataTest, HoldsEachPartOfTheRunWithOneClock) {
  const auto data = ReportData(out_, {"drive.bag", {}, {"The rig is assumed."}});
  EXPECT_EQ(data["input"], "drive.bag");
  EXPECT_EQ(data["assumptions"][0], "The rig is assumed.");
  for (const char* part : {"path", "scans", "states"}) {
    ASSERT_EQ(data[part]["t"].size(), std::size_t{test::kRunScans}) << part;
    EXPECT_EQ(data[part]["t"][0], 0.0) << part;
  }
  EXPECT_NEAR(data["path"]["x"][9], 45.0, 1e-6);
  EXPECT_EQ(data["states"]["status"][0], 1);
  EXPECT_EQ(data["states"]["trust"][0], 1);
  EXPECT_EQ(data["scans"]["nis"][0], 6.0);
  EXPECT_EQ(data["map"]["count"], 2);
  EXPECT_THAT(data["options"].get<std::string>(), HasSubstr("pipeline:"));
  EXPECT_EQ(data["verdict"]["trust"], "no");
  EXPECT_FALSE(data.contains("truth"));
}

TEST_F(ReportDataTest, NoticesHaveTimeSeverityAndText) {
  const auto notices = ReportData(out_, {})["notices"];
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].dump(), R"([0.3,"warning","a <b> & \"c\""])");
}

TEST_F(ReportDataTest, MissingPartsAreLeftOut) {
  for (const char* name : {"states.csv", "map.pcd", "notices.tsv", "stats.json"}) {
    std::filesystem::remove(out_ / name);
  }
  const auto data = ReportData(out_, {});
  EXPECT_FALSE(data.contains("states"));
  EXPECT_FALSE(data.contains("map"));
  EXPECT_TRUE(data["stats"].is_null());
}

TEST_F(ReportDataTest, ADamagedTableIsNamed) {
  folder_.Write("run/registration.csv", "t_s,nis\n1,many\n");
  try {
    static_cast<void>(ReportData(out_, {}));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("registration.csv:2"));
  }
}

}  // namespace
}  // namespace lio
