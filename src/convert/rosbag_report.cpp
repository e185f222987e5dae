// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "convert/ordered_log.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

class Lines {
 public:
  template <typename... Args>
  void Add(std::string_view name, fmt::format_string<Args...> format, Args&&... args) {
    text_ += fmt::format("{:<13}", name) + fmt::format(format, std::forward<Args>(args)...) + '\n';
  }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string Span(const StreamStats& stats) {
  if (stats.num() == 0) return "nothing";
  return fmt::format("stamps {} to {} ({:.3f} s)", StampText(*stats.first_stamp()),
                     StampText(*stats.last_stamp()), stats.span_s());
}

void AddStream(Lines& lines, const StreamStats& stats) {
  lines.Add("", "{}", Span(stats));
  lines.Add("",
            "received {:.1f} ms after the stamp on average; longest period {:.1f} ms, {} gaps, "
            "{} stamps not increasing",
            1e3 * stats.mean_delay_s(), 1e3 * stats.longest_gap_s(), stats.num_gaps(),
            stats.num_backwards());
}

void AddLidar(Lines& lines, const RosbagReport& report) {
  lines.Add("lidar", "{}: {} sweeps at {:.3f} Hz, {:.0f} points each", report.topics.lidar,
            report.lidar.num(), report.lidar.rate_hz(),
            static_cast<double>(report.num_points) / static_cast<double>(report.lidar.num()));
  AddStream(lines, report.lidar);
  lines.Add("", "fields {}", report.rules.fields);
  if (report.num_points_noise > 0) {
    lines.Add("", "left out: {} points that the sensor tags as noise", report.num_points_noise);
  }
  if (report.num_points_nonfinite + report.num_points_zero + report.num_empty > 0) {
    lines.Add("", "left out: {} points not finite, {} without return, {} clouds without points",
              report.num_points_nonfinite, report.num_points_zero, report.num_empty);
  }
  lines.Add("point time", "{}", report.rules.point_time_text);
  lines.Add("stamp", "{}", report.rules.stamp_text);
  lines.Add("ring", "{}", report.rules.ring.description);
  if (report.rules.intensity_scale != 1.0f) {
    lines.Add("intensity", "0..1 in the source, times {:.0f}", report.rules.intensity_scale);
  }
}

void AddImu(Lines& lines, const RosbagReport& report) {
  if (!report.topics.imu) {
    lines.Add("imu", "none: the log serves lidar-only odometry");
    return;
  }
  lines.Add("imu", "{}: {} samples at {:.2f} Hz", *report.topics.imu, report.imu.num(),
            report.imu.rate_hz());
  if (report.imu.num() == 0) return;
  AddStream(lines, report.imu);
  lines.Add("", "mean |accel| {:.3f}, in the quietest second {:.3f}: {}",
            report.accelerometer.mean_mps2(), report.accelerometer.quiet_mean_mps2(),
            report.accelerometer.Suggestion());
  lines.Add(
      "", "largest |gyro| {:.2f} rad/s{}", report.accelerometer.largest_rate_radps(),
      report.accelerometer.largest_rate_radps() > 35.0 ? ": looks like degrees a second" : "");
  if (report.accelerometer.num_nonfinite() > 0) {
    lines.Add("", "{} samples are not finite (passed on)", report.accelerometer.num_nonfinite());
  }
}

void AddTruth(Lines& lines, const RosbagReport& report, const RosbagOptions& options) {
  if (!report.truth) return;
  const TruthCounts& truth = *report.truth;
  lines.Add("truth", "{}: {} rows to {}", report.topics.truth.value_or(""), truth.num_rows,
            options.truth_file->string());
  lines.Add("", "{}", report.truth_description);
  if (truth.num_rows > 0) {
    lines.Add("", "stamps {} to {}, received {:.1f} ms later on average", StampText(*truth.first),
              StampText(*truth.last),
              1e3 * truth.delay_sum_s / static_cast<double>(truth.num_rows));
  }
  if (truth.num_not_good + truth.num_damaged + truth.num_not_later > 0) {
    lines.Add("", "left out: {} rows whose INS status is not good, {} damaged, {} not increasing",
              truth.num_not_good, truth.num_damaged, truth.num_not_later);
  }
}

void AddDamage(Lines& lines, const RosbagReport& report) {
  for (const auto& [reason, count] : report.num_damaged) {
    lines.Add("damaged", "{} messages skipped, {}", count, reason);
  }
  const BagDamage& damage = report.damage;
  if (!damage.Any()) return;
  lines.Add("damaged", "the bag {}: {} bytes lost, {} broken chunks, {} broken records{}",
            damage.cut_short    ? "is cut short"
            : damage.not_closed ? "was never closed, it has no index"
                                : "is hurt",
            damage.lost_bytes, damage.num_chunks_damaged, damage.num_messages_damaged,
            damage.num_messages_missing > 0
                ? fmt::format(", {} messages missing", damage.num_messages_missing)
                : "");
  if (!damage.first_reason.empty()) lines.Add("", "first: {}", damage.first_reason);
  lines.Add("", "converted up to {}",
            report.lidar.last_stamp() ? StampText(*report.lidar.last_stamp()) : "nothing");
}

}  // namespace

std::string FormatReport(const RosbagReport& report, const RosbagOptions& options) {
  Lines lines;
  lines.Add("input", "{}", options.input.string());
  for (const BagTopic& topic : report.all_topics) {
    lines.Add("", "{} ({}): {} messages", topic.name, topic.type, topic.num_messages);
  }
  AddLidar(lines, report);
  AddImu(lines, report);
  AddTruth(lines, report, options);
  AddDamage(lines, report);
  for (const std::string& note : report.notes) lines.Add("note", "{}", note);
  if (report.num_late_events > 0) {
    lines.Add("note", "{} events were received over {:.0f} s late and are logged at a later time",
              report.num_late_events, OrderedLog::kHold.Seconds());
  }
  lines.Add("output", "{}: {} events on {} and {}", options.output.string(), report.num_events,
            kScanChannel, kImuChannel);
  return lines.Take();
}

}  // namespace lio
