// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/status_report_json.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(StatusReportJson, NamesStateTrustLatenciesLoadAndClockOffset) {
  StatusReport report;
  report.state = TrackingStatus::kCoasting;
  report.trust = Trust::kDoubtful;
  report.latency = {1.0F, 2.0F, 3.0F};
  report.queue = {0.5F, 1.0F, 1.5F};
  report.cpu_load_cores = 0.25F;
  report.clock_offset = {.offset_s = 0.025, .std_s = 0.0004};
  const nlohmann::ordered_json json = StatusReportJson(report);
  EXPECT_EQ(json["state"], static_cast<int>(TrackingStatus::kCoasting));
  EXPECT_EQ(json["trust"], static_cast<int>(Trust::kDoubtful));
  EXPECT_EQ(json["latency_ms"]["p99"], 2.0);
  EXPECT_EQ(json["queue_ms"]["max"], 1.5);
  EXPECT_EQ(json["cpu_cores"], 0.25);
  EXPECT_EQ(json["clock_offset_s"], 0.025);
  EXPECT_EQ(json["clock_offset_std_s"], 0.0004);
}

}  // namespace
}  // namespace lio
