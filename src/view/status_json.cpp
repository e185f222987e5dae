// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/status_json.hpp"

#include <nlohmann/json.hpp>

#include "lio/base/counters_fields.hpp"
#include "lio/io/json_text.hpp"
#include "lio/io/status_report_json.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

// The counts that are zero where nothing is lost, by name; those that are zero are left out.
Json Losses(const StatusReport& report) {
  Json losses = Json::object();
  const auto add = [&losses](std::string_view name, std::int64_t count) {
    if (count > 0) losses[std::string(name)] = count;
  };
  for (const CounterField& field : kCounterFields) {
    constexpr std::size_t kPrefix = 4;  // "num_"
    const std::string_view name = field.name.substr(kPrefix);
    const bool is_traffic =
        name == "imu" || name == "chunks" || name == "scans" || name == "standstills";
    if (!is_traffic) add(name, report.counters.*field.count);
  }
  add("refused", report.input.TotalRefused());
  add("imu_seq_missing", report.input.num_imu_missing);
  add("imu_queue_dropped", report.num_imu_queue_dropped);
  add("chunk_queue_dropped", report.num_chunk_queue_dropped);
  add("kernel_dropped", report.num_kernel_dropped);
  add("publish_failed", report.num_publish_failed);
  add("outputs_dropped", report.num_outputs_dropped);
  add("handler_faults", report.num_handler_faults);
  return losses;
}

Json DaemonJson(const StatusReport& report) {
  Json json = StatusReportJson(report);
  json["scans"] = report.counters.num_scans;
  json["losses"] = Losses(report);
  return json;
}

Json MatchJson(const ScanReport& report) {
  return {{"used", report.num_used},
          {"matched", report.num_matched},
          {"rms_m", report.residual_rms_m},
          {"fused", report.fused},
          {"nis", report.nis},
          {"total_ms", 1e-6 * static_cast<double>(report.stage_ns.back())}};
}

}  // namespace

std::string StatusJson(const ViewState& view, std::int64_t now_utime) {
  // A recording's messages are counted by the recording's clock.
  const bool is_played = view.timeline().number > 0;
  const std::int64_t now = is_played ? view.timeline().value.utime : now_utime;
  Json rates;
  constexpr std::array kNames = {"odometry", "odometry_imu", "cloud", "cloud_full", "status"};
  for (std::size_t i = 0; i < kNumViewChannels; ++i) {
    rates[kNames[i]] = view.RateHz(static_cast<ViewChannel>(i), now);
  }
  Json json = {{"rates_hz", rates}, {"refused", view.num_refused()}, {"runs", view.num_runs()}};
  if (view.pose().number > 0) {
    json["silent_s"] = 1e-6 * static_cast<double>(now - view.pose().value.recv_utime);
  }
  if (view.status().number > 0) json["daemon"] = DaemonJson(view.status().value);
  if (view.registration().number > 0) json["match"] = MatchJson(view.registration().value);
  return TextOf(json);
}

std::string TimelineJson(const Timeline& timeline) {
  return TextOf({{"t_s", timeline.t_s},
                 {"duration_s", timeline.duration_s},
                 {"speed", timeline.speed},
                 {"playing", timeline.is_playing},
                 {"seeking", timeline.is_seeking}});
}

}  // namespace lio
