// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/status_report_json.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

Json LatencyJson(const LatencySummary& latency) {
  return {{"p50", latency.p50_ms}, {"p99", latency.p99_ms}, {"max", latency.max_ms}};
}

}  // namespace

Json StatusReportJson(const StatusReport& report) {
  return {{"state", static_cast<int>(report.state)},
          {"trust", static_cast<int>(report.trust)},
          {"note", report.note},
          {"latency_ms", LatencyJson(report.latency)},
          {"queue_ms", LatencyJson(report.queue)},
          {"compute_ms", LatencyJson(report.compute)},
          {"cpu_cores", report.cpu_load_cores},
          {"rss_mb", report.rss_mb},
          {"map_mb", report.map_mb},
          {"clock_offset_s", report.clock_offset.offset_s},
          {"clock_offset_std_s", report.clock_offset.std_s}};
}

}  // namespace lio
