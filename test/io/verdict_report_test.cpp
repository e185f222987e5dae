// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/verdict_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lio {
namespace {

Verdict ExampleVerdict() {
  Verdict verdict;
  verdict.trust = Trust::kNo;
  verdict.coverage = 0.98765;
  verdict.claimed.tilt_std_deg = 0.25;
  verdict.causes = {{CauseKind::kClockOffset, Trust::kNo, 12.34, "turns agree later",
                     "rig:\n  lidar:\n    clock_offset_s: 0.0250\n"}};
  return verdict;
}

TEST(VerdictReport, JsonHasAllOfIt) {
  const auto json = nlohmann::json::parse(VerdictJson(ExampleVerdict()));
  EXPECT_EQ(json["trust"], "no");
  EXPECT_EQ(json["coverage"], 0.9877);
  EXPECT_TRUE(json["claimed"]["position_std_m_per_100m"].is_null());
  EXPECT_EQ(json["claimed"]["tilt_std_deg"], 0.25);
  ASSERT_EQ(json["causes"].size(), 1U);
  EXPECT_EQ(json["causes"][0]["kind"], "clock_offset");
  EXPECT_EQ(json["causes"][0]["leaves"], "no");
  EXPECT_EQ(json["causes"][0]["sigma"], 12.3);
  EXPECT_EQ(json["causes"][0]["fix"], ExampleVerdict().causes[0].fix);
}

TEST(VerdictReport, SummaryHasTheLinesForTheConfiguration) {
  EXPECT_EQ(VerdictSummary(ExampleVerdict()),
            "trust: no; poses for 99 % of the time; claimed: 0.25 deg of tilt (1 sigma)\n"
            "  clock_offset: turns agree later\n"
            "    put into the configuration:\n"
            "      rig:\n        lidar:\n          clock_offset_s: 0.0250\n");
}

TEST(VerdictReport, MendedCausesFollowAndAFixOfSeveralStandsOnce) {
  Verdict verdict;
  verdict.trust = Trust::kYes;
  verdict.coverage = 1.0;
  verdict.mended = {{CauseKind::kLeverArm, Trust::kNo, 9.0, "it is elsewhere", "rig: {}\n"},
                    {CauseKind::kImuAxes, Trust::kNo, 9.0, "it is turned", "rig: {}\n"}};
  EXPECT_EQ(VerdictSummary(verdict),
            "trust: yes; poses for 100 % of the time\n"
            "  mended by the first pass: lever_arm: it is elsewhere\n"
            "    for liod and other drives put into the configuration:\n"
            "      rig: {}\n"
            "  mended by the first pass: imu_axes: it is turned\n");
  const auto json = nlohmann::json::parse(VerdictJson(verdict));
  ASSERT_EQ(json["mended"].size(), 2U);
  EXPECT_EQ(json["mended"][1]["kind"], "imu_axes");
}

TEST(VerdictReport, TrustedRunHasOneLine) {
  Verdict verdict;
  verdict.trust = Trust::kYes;
  verdict.coverage = 1.0;
  EXPECT_EQ(VerdictSummary(verdict), "trust: yes; poses for 100 % of the time\n");
  EXPECT_TRUE(nlohmann::json::parse(VerdictJson(verdict))["causes"].empty());
}

}  // namespace
}  // namespace lio
