// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/stream_feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lio::test {
namespace {

constexpr int kImuRate_hz = 100;
constexpr int kSamplesPerSweep = 10;
constexpr std::uint32_t kSweepSpan_ns = 90'000'000;

bool IsOf(Sensor sensor, const SensorMessage& message) {
  return sensor == Sensor::kBoth || (sensor == Sensor::kLidar) == message.chunk.has_value();
}

struct LineOf {
  std::string operator()(const ImuReady& event) const {
    return At(event.is_made_up ? "made up" : "imu", event.sample.stamp);
  }
  std::string operator()(const SweepReady& event) const { return At("sweep", event.sweep->start); }
  std::string operator()(const SegmentStarts& event) const {
    return At("segment", event.first.stamp);
  }
  std::string operator()(const AmbiguousClockStep& event) const {
    return At("ambiguous", event.stamps.before) + At(" to", event.stamps.after);
  }
  std::string operator()(const ImuAbsent& event) const { return At("absent", event.stamp); }
  std::string operator()(const ImuAppeared& event) const { return At("appeared", event.first); }
  std::string operator()(const StreamEnded& /*event*/) const { return "ended"; }
  std::string operator()(const Notice& event) const {
    return At("notice", event.stamp) + ": " + event.text;
  }

 private:
  static std::string At(const char* kind, Timestamp stamp) {
    return fmt::format("{} {:.3f}", kind, SecondsOf(stamp));
  }
};

}  // namespace

SensorMessage ImuAt(double taken_s) {
  SensorMessage message;
  message.taken_s = taken_s;
  message.sample.stamp = StampAt(taken_s);
  message.sample.w_imu_radps = Vector3(1e-3 * std::sin(31.0 * taken_s), 0.0, 0.0);
  message.sample.f_imu_mps2 = Vector3(0.0, 0.02 * std::sin(37.0 * taken_s), 9.81);
  return message;
}

SensorMessage SweepFrom(double taken_s) {
  SensorMessage message;
  message.taken_s = taken_s;
  ScanChunk chunk;
  chunk.stamp = StampAt(taken_s);
  chunk.scan_seq = static_cast<std::int32_t>(std::lround(10.0 * taken_s));
  chunk.points.resize(2);
  chunk.points.back().t_offset_ns = kSweepSpan_ns;
  message.chunk = std::move(chunk);
  return message;
}

SensorMessages Sensors(double from_s, double to_s) {
  SensorMessages messages;
  const auto first = static_cast<int>(std::lround(kImuRate_hz * from_s));
  const auto end = static_cast<int>(std::lround(kImuRate_hz * to_s));
  for (int i = first; i < end; ++i) {
    messages.push_back(ImuAt(static_cast<double>(i) / kImuRate_hz));
    if (i % kSamplesPerSweep != 0 || i - kSamplesPerSweep < first) continue;
    messages.push_back(SweepFrom(static_cast<double>(i - kSamplesPerSweep) / kImuRate_hz));
  }
  return messages;
}

SensorMessages Silenced(SensorMessages messages, Sensor sensor, double from_s, double to_s) {
  std::erase_if(messages, [&](const SensorMessage& message) {
    return IsOf(sensor, message) && message.taken_s >= from_s && message.taken_s < to_s;
  });
  return messages;
}

SensorMessages OnlyImu(double from_s, double to_s) {
  return Silenced(Sensors(from_s, to_s), Sensor::kLidar, from_s, to_s);
}

SensorMessages OnlyLidar(double from_s, double to_s) {
  return Silenced(Sensors(from_s, to_s), Sensor::kImu, from_s, to_s);
}

SensorMessages Stepped(SensorMessages messages, Sensor sensor, double from_s, double step_s) {
  const Duration step = Duration::FromSeconds(step_s);
  for (SensorMessage& message : messages) {
    if (!IsOf(sensor, message) || message.taken_s < from_s) continue;
    Timestamp& stamp = message.chunk ? message.chunk->stamp : message.sample.stamp;
    stamp = stamp + step;
  }
  return messages;
}

std::string Line(const StreamEvent& event) {
  return std::visit(LineOf{}, event);
}

std::vector<std::string> Lines(const std::vector<StreamEvent>& events) {
  std::vector<std::string> lines;
  for (const StreamEvent& event : events) lines.push_back(Line(event));
  return lines;
}

double LargestStep_s(const std::vector<Timestamp>& stamps) {
  double largest_s = 0.0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    largest_s = std::max(largest_s, std::abs(SecondsBetween(stamps[i - 1], stamps[i])));
  }
  return largest_s;
}

void StreamRun::Add(const SensorMessage& message) {
  if (message.chunk) {
    stream.AddChunk(*message.chunk, 0);
  } else {
    stream.AddImu(message.sample);
  }
}

void StreamRun::Drain(bool is_idle) {
  while (std::optional<StreamEvent> event = stream.Next(is_idle ? 0 : 1)) {
    events.push_back(std::move(*event));
  }
}

void StreamRun::Feed(const SensorMessages& messages, bool is_idle) {
  for (const SensorMessage& message : messages) {
    Add(message);
    Drain(is_idle);
  }
}

void StreamRun::Finish() {
  stream.Flush();
  Drain();
}

std::vector<Timestamp> StreamRun::MeasuredStamps() const {
  std::vector<Timestamp> stamps;
  for (const ImuReady& event : Of<ImuReady>()) {
    if (!event.is_made_up) stamps.push_back(event.sample.stamp);
  }
  return stamps;
}

std::vector<Timestamp> StreamRun::SweepStarts() const {
  std::vector<Timestamp> starts;
  for (const SweepReady& event : Of<SweepReady>()) starts.push_back(event.sweep->start);
  return starts;
}

}  // namespace lio::test
