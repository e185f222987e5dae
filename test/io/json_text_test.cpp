// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/json_text.hpp"

#include <gtest/gtest.h>

#include "lio/io/status_report_json.hpp"

namespace lio {
namespace {

TEST(JsonText, ReplacesBytesThatAreNoUtf8) {
  StatusReport report;
  report.note = "a \xff note";
  const auto json = nlohmann::ordered_json::parse(TextOf(StatusReportJson(report)));
  EXPECT_EQ(json["note"], "a \xEF\xBF\xBD note");
}

}  // namespace
}  // namespace lio
