// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/input_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lio/io/socket_buffer.hpp"

namespace lio {
namespace {

std::string OnOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

// Returns the address of udpm://ADDRESS:PORT?...
std::string GroupOf(const std::string& url) {
  const std::string rest = url.substr(url.find("//") + 2);
  return rest.substr(0, rest.find_first_of(":?"));
}

}  // namespace

bool InputWatch::Growth::Take(std::int64_t now_at, Clock::duration step) {
  const bool grew = now_at > count;
  count = now_at;
  still_for = grew ? Clock::duration{0} : still_for + step;
  growing_for = still_for <= kMaxStep ? growing_for + step : Clock::duration{0};
  return grew;
}

std::string InputWatch::WhereToLook() const {
  if (names_.url.starts_with("tcpq:")) return "is a sender connected to the same server?";
  const std::string group = GroupOf(names_.url);
  return fmt::format(
      "is a sender running, with these channel names and this URL? See the multicast route: ip "
      "route get {} (for this machine alone: sudo ip link set lo up && sudo ip route add "
      "224.0.0.0/4 dev lo); a sender on another machine needs ?ttl=1 in its URL",
      group.empty() ? "239.255.76.67" : group);
}

std::string InputWatch::SilenceText(const InputCounters& input) const {
  const std::string channels = names_.uses_imu ? names_.imu + " and " + names_.scan : names_.scan;
  const std::int64_t num_refused = input.num_imu_received - input.num_imu_taken +
                                   input.num_chunks_received - input.num_chunks_taken;
  if (num_refused > 0) {
    return fmt::format(
        "nothing usable comes on {}: {} messages were refused, so the sender's types are not those "
        "of lcmtypes/ (docs/messages.md has the fingerprints)",
        channels, num_refused);
  }
  return fmt::format("nothing comes on {} over {}: {}", channels, names_.url, WhereToLook());
}

void InputWatch::Judge(Fault& fault, bool begins, bool is_over, const std::string& text,
                       std::vector<InputRemark>& remarks) const {
  if (!fault.lasts && begins) {
    fault = {true, text};
    remarks.push_back({true, text});
  } else if (fault.lasts && is_over) {
    remarks.push_back({false, "no longer so: " + fault.text.substr(0, fault.text.find(':'))});
    fault = {};
  }
}

std::string InputWatch::SecondDaemonText(std::int64_t start_utime) const {
  return fmt::format(
      "another liod publishes on {} and the other channels of this one: its start_utime is {}, its "
      "messages mix with ours; end one of both, or give one its own --channel-prefix or --lcm-url",
      names_.status, start_utime);
}

std::vector<InputRemark> InputWatch::Look(const StatusReport& report,
                                          const OtherDaemons::Heard& others,
                                          Clock::time_point now) {
  const Clock::duration step = std::min<Clock::duration>(now - last_look_, kMaxStep);
  last_look_ = now;
  const InputCounters& input = report.input;
  imu_.Take(input.num_imu_taken, step);
  chunks_.Take(input.num_chunks_taken, step);
  const bool loses_datagrams = kernel_drops_.Take(report.num_kernel_dropped, step);
  const bool loses_scans =
      scan_drops_.Take(report.counters.num_scans_dropped + report.num_chunk_queue_dropped, step);

  const auto is_silent = [](const Growth& growth) { return growth.still_for >= kPatience; };
  const auto comes = [](const Growth& growth) { return growth.growing_for >= kRecovery; };
  const bool misses_imu = names_.uses_imu && is_silent(imu_);
  const bool misses_scans = is_silent(chunks_);
  const bool misses_all = misses_scans && (misses_imu || !names_.uses_imu);
  std::vector<InputRemark> remarks;
  Judge(silence_, misses_all, comes(chunks_) || (names_.uses_imu && comes(imu_)),
        SilenceText(input), remarks);
  Judge(without_imu_, misses_imu && !misses_scans && comes(chunks_), comes(imu_),
        fmt::format("scans come, but no inertial samples on {}: is the IMU's driver running, with "
                    "this channel name? Without an IMU: pipeline.use_imu: false",
                    names_.imu),
        remarks);
  Judge(
      without_scans_, names_.uses_imu && misses_scans && !misses_imu && comes(imu_), comes(chunks_),
      fmt::format("inertial samples come, but no scans on {}: is the lidar's driver running, with "
                  "this channel name? Messages above {} kB need a larger receive buffer",
                  names_.scan, report.receive_buffer_bytes / 1024),
      remarks);
  Judge(kernel_loss_, loses_datagrams, kernel_drops_.still_for >= kPatience,
        OnOneLine("the kernel drops datagrams for want of receive buffer: scans have holes; allow "
                  "more with " +
                  ReceiveBufferAdvice()),
        remarks);
  Judge(
      overload_, loses_scans, scan_drops_.still_for >= kPatience,
      "scans are dropped: they come faster than they are matched; see compute_p99_ms and cpu_load "
      "of LIO_STATUS, and what else runs on this machine",
      remarks);
  const bool hears_another = others_.Take(others.num, step);
  Judge(second_daemon_, hears_another, others_.still_for >= kPatience,
        SecondDaemonText(others.start_utime), remarks);
  return remarks;
}

std::string InputWatch::standing() const {
  std::string text;
  for (const Fault* fault :
       {&silence_, &without_imu_, &without_scans_, &kernel_loss_, &overload_, &second_daemon_}) {
    if (fault->lasts) text += (text.empty() ? "" : " | ") + fault->text;
  }
  return text;
}

}  // namespace lio
