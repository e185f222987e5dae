// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lio/convert/pcap_convert.hpp"
#include "lio/io/trajectory_file.hpp"
#include "ordered_log.hpp"

namespace lio {
namespace {

std::string Line(std::string_view name, const std::string& text) {
  return fmt::format("{:<13}{}\n", name, text);
}

std::string StreamText(const StreamStats& stats) {
  return Line("", fmt::format("stamps {} to {} ({:.3f} s)", StampText(*stats.first_stamp()),
                              StampText(*stats.last_stamp()), stats.span_s())) +
         Line("", fmt::format("received {:.1f} ms after the stamp on average; longest period "
                              "{:.1f} ms, {} gaps, {} stamps not increasing",
                              1e3 * stats.mean_delay_s(), 1e3 * stats.longest_gap_s(),
                              stats.num_gaps(), stats.num_backwards()));
}

std::string ImuText(const PcapReport& report) {
  if (report.imu.num() == 0) {
    return Line("imu", "none: the log serves lidar-only odometry; give one with --imu FILE");
  }
  return Line("imu", fmt::format("{}: {} samples at {:.2f} Hz", report.imu_text, report.imu.num(),
                                 report.imu.rate_hz())) +
         StreamText(report.imu) +
         Line("",
              fmt::format("mean |accel| {:.3f}, in the quietest second {:.3f}: {}",
                          report.accelerometer.mean_mps2(), report.accelerometer.quiet_mean_mps2(),
                          report.accelerometer.Suggestion()));
}

std::string DamageText(const PcapReport& report) {
  std::string text;
  const auto add = [&text](std::int64_t count, std::string_view what) {
    if (count > 0) text += Line("damaged", fmt::format("{} {}", count, what));
  };
  add(report.losses.num_frames_cut,
      "frames captured with fewer bytes than were sent, or malformed");
  add(report.losses.num_fragments_lost, "fragments of datagrams that are not whole");
  add(report.losses.num_packets_damaged, "packets whose content contradicts their format");
  add(report.losses.num_imu_damaged, "inertial samples that cannot be read");
  if (!report.losses.fault.empty())
    text += Line("damaged", "the capture ends early: " + report.losses.fault);
  return text;
}

}  // namespace

std::string FormatReport(const PcapReport& report, const PcapOptions& options) {
  std::string text = Line("input", options.input.string());
  text += Line("lidar",
               fmt::format("{} at {}: {} sweeps at {:.3f} Hz, {:.0f} points each", report.model,
                           report.sensor, report.lidar.num(), report.lidar.rate_hz(),
                           static_cast<double>(report.num_points) /
                               static_cast<double>(report.lidar.num())));
  text += StreamText(report.lidar);
  text += Line("clock", report.clock_text);
  text += Line("packets", fmt::format("{} decoded, {} lost on the way, {} turns in parts left out",
                                      report.num_packets, report.losses.num_packets_lost,
                                      report.num_parts_of_turns));
  text += Line("", fmt::format("passed over: {} datagrams of others, {} frames without UDP",
                               report.num_datagrams_other, report.num_frames_other));
  text += ImuText(report);
  text += DamageText(report);
  if (report.num_late_events > 0) {
    text += Line("note", fmt::format("{} events were received over {:.0f} s late and are logged "
                                     "at a later time: do the clocks of lidar and IMU agree?",
                                     report.num_late_events, OrderedLog::kHold.Seconds()));
  }
  return text + Line("output", fmt::format("{}: {} events on {} and {}", options.output.string(),
                                           report.num_events, kScanChannel, kImuChannel));
}

}  // namespace lio
