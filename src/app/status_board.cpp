// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/status_board.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace lio {
namespace {

float ResidentMb() {
  std::int64_t total_pages = 0;
  std::int64_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  return static_cast<float>(resident_pages * ::sysconf(_SC_PAGESIZE)) * 1e-6F;
}

LatencySummary Summarise(std::vector<float>& values_ms) {
  if (values_ms.empty()) return {};
  std::sort(values_ms.begin(), values_ms.end());
  const auto at = [&](double share) {
    return values_ms[std::lround(share * static_cast<double>(values_ms.size() - 1))];
  };
  return {at(0.5), at(0.99), values_ms.back()};
}

}  // namespace

std::int64_t ProcessCpuMicroseconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto us = [](const timeval& t) { return std::int64_t{t.tv_sec} * 1'000'000 + t.tv_usec; };
  return us(usage.ru_utime) + us(usage.ru_stime);
}

StatusBoard::StatusBoard(std::string options, std::int32_t receive_buffer_bytes,
                         double configured_offset_s, StatusClocks clocks)
    : clocks_(std::move(clocks)),
      options_(std::move(options)),
      configured_offset_s_(configured_offset_s),
      last_utime_(clocks_.host_utime()),
      last_cpu_us_(clocks_.process_cpu_us()) {
  report_.start_utime = last_utime_;
  report_.config_hash = Fnv1a(options_);
  report_.receive_buffer_bytes = receive_buffer_bytes;
  report_.clock_offset.offset_s = configured_offset_s;
}

void StatusBoard::SetEstimator(const Counters& counters, TrackingStatus state,
                               Timestamp newest_stamp) {
  const std::lock_guard lock(mutex_);
  report_.counters = counters;
  report_.state = state;
  report_.newest_stamp = newest_stamp;
}

void StatusBoard::SetImuNoise(const ImuNoiseRatios& ratios) {
  const std::lock_guard lock(mutex_);
  report_.imu_noise = ratios;
}

void StatusBoard::SetClockOffset(const ClockOffsetStatus& offset) {
  const std::lock_guard lock(mutex_);
  report_.clock_offset = offset;
}

void StatusBoard::ForgetClockOffset() {
  SetClockOffset({.offset_s = configured_offset_s_, .std_s = 0.0});
}

void StatusBoard::SetTrust(Trust trust) {
  const std::lock_guard lock(mutex_);
  report_.trust = trust;
}

void StatusBoard::SetInput(const InputCounters& counters) {
  const std::lock_guard lock(mutex_);
  report_.input = counters;
}

void StatusBoard::SetNote(std::string note) {
  const std::lock_guard lock(mutex_);
  report_.note = std::move(note);
}

void StatusBoard::SetAlarm(std::string alarm) {
  const std::lock_guard lock(mutex_);
  alarm_ = std::move(alarm);
}

void StatusBoard::TellOptions() {
  const std::lock_guard lock(mutex_);
  tells_options_ = true;
}

void StatusBoard::CountRefusedCommand() {
  const std::lock_guard lock(mutex_);
  ++report_.num_commands_refused;
}

void StatusBoard::AddLatency(double queue_ms, double compute_ms) {
  const std::lock_guard lock(mutex_);
  latencies_.queue_ms.push_back(static_cast<float>(queue_ms));
  latencies_.compute_ms.push_back(static_cast<float>(compute_ms));
  latencies_.total_ms.push_back(static_cast<float>(queue_ms + compute_ms));
}

std::int64_t StatusBoard::start_utime() const {
  const std::lock_guard lock(mutex_);
  return report_.start_utime;
}

InputCounters StatusBoard::input() const {
  const std::lock_guard lock(mutex_);
  return report_.input;
}

StatusReport StatusBoard::Compose() {
  const std::lock_guard lock(mutex_);
  report_.utime = clocks_.host_utime();
  const std::int64_t cpu_us = clocks_.process_cpu_us();
  const std::int64_t elapsed_us = std::max<std::int64_t>(report_.utime - last_utime_, 1);
  report_.cpu_load_cores =
      static_cast<float>(cpu_us - last_cpu_us_) / static_cast<float>(elapsed_us);
  report_.rss_mb = ResidentMb();
  last_utime_ = report_.utime;
  last_cpu_us_ = cpu_us;
  report_.queue = Summarise(latencies_.queue_ms);
  report_.compute = Summarise(latencies_.compute_ms);
  report_.latency = Summarise(latencies_.total_ms);
  latencies_ = {};
  StatusReport report = report_;
  if (!alarm_.empty()) report.note = alarm_;
  if (std::exchange(tells_options_, false)) report.options = options_;
  ++report_.seq;
  return report;
}

}  // namespace lio
