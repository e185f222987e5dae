// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Messages of an IMU and a lidar for a SensorStream, faults that can be put into them, and the
// events that the stream makes of them.
//
// The IMU sends 100 samples a second, each as it is taken. The lidar makes ten sweeps a second of
// 90 ms each, one chunk a sweep, which arrives 100 ms after its first point was taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/stream/sensor_stream.hpp"
#include "support/motion.hpp"

namespace lio::test {

struct SensorMessage {
  double taken_s = 0.0;            // true time of the sample or of the sweep's first point
  std::optional<ScanChunk> chunk;  // absent: the message is the sample
  ImuSample sample;
};
using SensorMessages = std::vector<SensorMessage>;

// A sample of a body at rest with a little vibration: no two of them are equal.
SensorMessage ImuAt(double taken_s);
SensorMessage SweepFrom(double taken_s);
// All that arrives from `from_s` on and before `to_s`, in order of arrival.
SensorMessages Sensors(double from_s, double to_s);

enum class Sensor { kImu, kLidar, kBoth };
// Without what that sensor took from `from_s` on and before `to_s`.
SensorMessages Silenced(SensorMessages messages, Sensor sensor, double from_s, double to_s);
// All that one of them sends alone, as Sensors().
SensorMessages OnlyImu(double from_s, double to_s);
SensorMessages OnlyLidar(double from_s, double to_s);
// The clock of that sensor steps by `step_s` at `from_s`.
SensorMessages Stepped(SensorMessages messages, Sensor sensor, double from_s, double step_s);

// For people and for comparisons: the event's kind and its stamps in seconds after kEpoch, e.g.
// "imu 0.010", "made up 0.201", "sweep 0.000", "segment 5.000".
std::string Line(const StreamEvent& event);
std::vector<std::string> Lines(const std::vector<StreamEvent>& events);

// Seconds that are counted from kEpoch and summed differ by less.
inline constexpr double kRounding_s = 1e-6;

// Returns the largest difference between neighbours, to either side.
double LargestStep_s(const std::vector<Timestamp>& stamps);

// A stream and the events that it has given so far.
struct StreamRun {
  explicit StreamRun(const StreamOptions& options = {}) : stream(options, counters) {}
  StreamRun(const StreamRun&) = delete;
  StreamRun& operator=(const StreamRun&) = delete;

  void Add(const SensorMessage& message);
  void Drain(bool is_idle = true);
  // Adds the messages one by one and takes what the stream gives after each.
  void Feed(const SensorMessages& messages, bool is_idle = true);
  void Finish();

  // Returns events of one kind, in order.
  template <class Event>
  std::vector<Event> Of() const {
    std::vector<Event> found;
    for (const StreamEvent& event : events) {
      if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
    }
    return found;
  }
  std::vector<Timestamp> MeasuredStamps() const;  // excludes inertial samples that were made up
  std::vector<Timestamp> SweepStarts() const;

  Counters counters;
  SensorStream stream;
  std::vector<StreamEvent> events;
};

}  // namespace lio::test
