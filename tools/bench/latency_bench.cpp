// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Plays a log to a running liod and measures how long its answers take: from an inertial sample to
// its LIO_ODOM_IMU, and from the last chunk of a scan to its LIO_ODOM. Times are those of the
// host's clock: before a message is sent, and when the kernel received the answer. A thread that
// sends each inertial sample back as it is shows what LCM and the machine alone take.
//   lio-bench-latency LOG SPEED
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "lio/io/bus.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/host_clock.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/quantile_sketch.hpp"

namespace lio {
namespace {

constexpr std::size_t kUtimeOffset = 8;     // in odometry_t and imu_t, behind the fingerprint
constexpr std::size_t kScanSeqOffset = 16;  // in odometry_t
constexpr const char* kEchoChannel = "LIO_ECHO";
constexpr int kQueueCapacity = 10'000;
constexpr double kBinsPerDecade = 5.0;

std::int64_t ReadInt64(ByteView bytes, std::size_t at) {
  if (bytes.size() < at + 8) return -1;
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + 8; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

// Pairs what was sent with what came back.
class Stopwatch {
 public:
  void Start(std::int64_t key, std::int64_t utime) {
    const std::lock_guard lock(mutex_);
    started_[key] = utime;
    ++num_started_;
  }
  void Stop(std::int64_t key, std::int64_t utime) {
    const std::lock_guard lock(mutex_);
    const auto found = started_.find(key);
    if (found == started_.end()) return;
    const double ms = static_cast<double>(utime - found->second) * 1e-3;
    started_.erase(found);
    times_ms_.Add(ms);
    const double clipped_ms = std::max(ms, 1e-3);
    ++bins_[static_cast<int>(std::floor(std::log10(clipped_ms) * kBinsPerDecade))];
    ++num_stopped_;
  }
  void Print(const char* name) const {
    std::printf("%s: %d of %d answered\n", name, num_stopped_, num_started_);
    if (times_ms_.empty()) return;
    std::printf("  p50 %.3f ms, p90 %.3f ms, p99 %.3f ms, max %.3f ms\n", times_ms_.Quantile(0.5),
                times_ms_.Quantile(0.9), times_ms_.Quantile(0.99), times_ms_.max());
    for (const auto& [bin, count] : bins_) {
      const int width = 60 * count / num_stopped_;
      std::printf("  %9.3f ms .. %7d %s\n", std::pow(10.0, bin / kBinsPerDecade), count,
                  std::string(static_cast<std::size_t>(width), '#').c_str());
    }
  }

 private:
  std::mutex mutex_;  // guards everything below; Print is called after the threads
  std::map<std::int64_t, std::int64_t> started_;
  QuantileSketch times_ms_;
  std::map<int, int> bins_;
  int num_started_ = 0;
  int num_stopped_ = 0;
};

struct Stopwatches {
  Stopwatch imu, echo, scan;
};

void Send(const LogEvent& event, const Channels& channels, Bus& bus, Stopwatches& watches) {
  const std::int64_t now = HostUtime();
  if (event.channel == channels.imu) {
    const std::int64_t utime = ReadInt64(event.data, kUtimeOffset);
    watches.imu.Start(utime, now);
    watches.echo.Start(utime, now);
  }
  ScanChunk chunk;
  if (event.channel == channels.scan && DecodeChunk(event.data, chunk) == DecodeStatus::kOk &&
      chunk.chunk_index + 1 == chunk.chunk_count) {
    watches.scan.Start(chunk.scan_seq, now);
  }
  if (!bus.Publish(event.channel, event.data)) std::fputs("a message could not be sent\n", stderr);
}

void Play(const std::string& log, double speed, Stopwatches& watches) {
  const std::unique_ptr<Bus> bus = OpenLcmBus("");
  const Channels channels;
  EventLogReader reader(log);
  LogEvent event;
  std::int64_t first_utime = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (bool is_first = true; reader.Next(event); is_first = false) {
    if (is_first) first_utime = event.utime;
    const double at_us = static_cast<double>(event.utime - first_utime) / speed;
    std::this_thread::sleep_until(begin +
                                  std::chrono::microseconds(static_cast<std::int64_t>(at_us)));
    Send(event, channels, *bus, watches);
  }
}

// Until the player has ended and no answer comes any more.
void Listen(const std::atomic<bool>& has_played, Bus& bus) {
  constexpr std::chrono::milliseconds kQuiet(500);
  for (;;) {
    const bool is_last_wait = has_played;
    if (bus.Receive(kQuiet) != ReceiveResult::kMessage && is_last_wait) return;
  }
}

// Sends what it receives back, until `token` asks to end.
void Echo(const std::stop_token& token, Bus& bus) {
  constexpr std::chrono::milliseconds kLookInterval(50);
  while (!token.stop_requested()) (void)bus.Receive(kLookInterval);
}

void Measure(const std::string& log, double speed) {
  const Channels channels;
  const std::unique_ptr<Bus> bus = OpenLcmBus("");
  Stopwatches watches;
  bus->Subscribe(channels.odometry_imu_rate, kQueueCapacity,
                 [&](ByteView data, std::int64_t utime) {
                   watches.imu.Stop(ReadInt64(data, kUtimeOffset), utime);
                 });
  bus->Subscribe(kEchoChannel, kQueueCapacity, [&](ByteView data, std::int64_t utime) {
    watches.echo.Stop(ReadInt64(data, kUtimeOffset), utime);
  });
  bus->Subscribe(channels.odometry, kQueueCapacity, [&](ByteView data, std::int64_t utime) {
    watches.scan.Stop(ReadInt64(data, kScanSeqOffset), utime);
  });
  const std::unique_ptr<Bus> echo_bus = OpenLcmBus("");
  echo_bus->Subscribe(channels.imu, kQueueCapacity, [&](ByteView data, std::int64_t) {
    if (!echo_bus->Publish(kEchoChannel, data)) std::fputs("an echo could not be sent\n", stderr);
  });
  const std::jthread echo([&](const std::stop_token& token) { Echo(token, *echo_bus); });
  std::atomic<bool> has_played = false;
  const std::jthread player([&] {
    Play(log, speed, watches);
    has_played = true;
  });
  Listen(has_played, *bus);
  watches.imu.Print("inertial sample to LIO_ODOM_IMU");
  watches.echo.Print("inertial sample to its echo");
  watches.scan.Print("last chunk of a scan to LIO_ODOM");
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  const double speed = argc == 3 ? std::atof(argv[2]) : 0.0;
  if (speed <= 0.0) {
    std::fputs("usage: lio-bench-latency LOG SPEED\n", stderr);
    return 2;
  }
  try {
    lio::Measure(argv[1], speed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lio-bench-latency: %s\n", error.what());
    return 5;
  }
  return 0;
}
