// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/status_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "view/view_fixture.hpp"

namespace lio {
namespace {

using nlohmann::json;
using test::NavAt;
using test::StatusOfRun;
using test::UtimeAt;

TEST(StatusJson, WithoutADaemonOnlyRatesAreKnown) {
  const json status = json::parse(StatusJson(ViewState(), UtimeAt(0)));
  EXPECT_FALSE(status.contains("daemon"));
  EXPECT_FALSE(status.contains("silent_s"));
  EXPECT_EQ(status["rates_hz"]["odometry"], 0.0);
}

TEST(StatusJson, HasStateVerdictLatencyAndLosses) {
  ViewState view;
  StatusReport report = StatusOfRun(1);
  report.state = TrackingStatus::kCoasting;
  report.trust = Trust::kDoubtful;
  report.latency = {1.0F, 2.0F, 3.0F};
  report.counters.num_imu = 100;
  report.counters.num_gated = 2;
  report.num_kernel_dropped = -1;
  report.note = "a \xff note";
  view.OnStatus(report, UtimeAt(0));
  const json daemon = json::parse(StatusJson(view, UtimeAt(0)))["daemon"];
  EXPECT_EQ(daemon["state"], 3);
  EXPECT_EQ(daemon["trust"], 1);
  EXPECT_EQ(daemon["latency_ms"]["p99"], 2.0);
  EXPECT_EQ(daemon["losses"], json({{"gated", 2}}));
}

TEST(StatusJson, SilenceIsMeasuredByTheClockOfWhatIsShown) {
  ViewState view;
  view.OnOdometry(NavAt(0), UtimeAt(0));
  EXPECT_NEAR(json::parse(StatusJson(view, UtimeAt(2)))["silent_s"].get<double>(), 2.0, 1e-6);
  view.SetTimeline({.utime = UtimeAt(0.5)});
  EXPECT_NEAR(json::parse(StatusJson(view, UtimeAt(2)))["silent_s"].get<double>(), 0.5, 1e-6);
}

TEST(StatusJson, TheMatchHasItsFigures) {
  ViewState view;
  ScanReport report;
  report.num_used = 10;
  report.num_matched = 9;
  report.stage_ns.back() = 2'500'000;
  view.OnRegistration(report);
  const json match = json::parse(StatusJson(view, UtimeAt(0)))["match"];
  EXPECT_EQ(match["matched"], 9);
  EXPECT_EQ(match["total_ms"], 2.5);
}

TEST(TimelineJson, SaysWhereItIsAndWhetherItPlays) {
  const json timeline =
      json::parse(TimelineJson({.t_s = 1.0, .duration_s = 2.0, .speed = 5.0, .is_playing = true}));
  EXPECT_EQ(timeline, json({{"t_s", 1.0},
                            {"duration_s", 2.0},
                            {"speed", 5.0},
                            {"playing", true},
                            {"seeking", false}}));
}

}  // namespace
}  // namespace lio
