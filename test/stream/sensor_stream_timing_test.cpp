// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The events do not depend on when the consumer asks for them, nor on how fast scans are matched.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/stream/sensor_stream.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::Lines;
using test::Sensor;
using test::SensorMessages;
using test::Sensors;
using test::Silenced;
using test::Stepped;
using test::StreamRun;
using Texts = std::vector<std::string>;

// Has everything that starts a segment, and everything that does not.
SensorMessages FaultyDrive() {
  SensorMessages messages = Sensors(0.0, 12.0);
  messages = Stepped(messages, Sensor::kImu, 1.5, -3.0);
  messages = Stepped(messages, Sensor::kBoth, 3.0, 0.4);
  messages = Silenced(messages, Sensor::kImu, 4.5, 4.9);
  messages = Silenced(messages, Sensor::kBoth, 6.0, 7.5);
  messages = Stepped(messages, Sensor::kBoth, 9.0, -2.0);
  messages.insert(messages.begin() + 500, messages[490]);
  return messages;
}

// A matcher that takes one sweep at a time and needs as long as `num_messages` take to arrive.
class Matcher {
 public:
  explicit Matcher(int num_messages) : num_messages_(num_messages) {}

  bool is_idle() const { return num_left_ <= 0; }
  void OnMessage() { --num_left_; }
  void OnEvent(const StreamEvent& event) {
    if (std::holds_alternative<SweepReady>(event)) num_left_ = num_messages_;
  }

 private:
  int num_messages_;
  int num_left_ = 0;
};

void Take(StreamRun& run, Matcher& matcher) {
  while (std::optional<StreamEvent> event = run.stream.Next(matcher.is_idle())) {
    matcher.OnEvent(*event);
    run.events.push_back(std::move(*event));
  }
}

Texts EventsOf(const SensorMessages& messages, int ask_every, int match_messages) {
  StreamRun run;
  run.stream.SetBegin(test::StampAt(0.0));
  Matcher matcher(match_messages);
  int num_added = 0;
  for (const test::SensorMessage& message : messages) {
    run.Add(message);
    matcher.OnMessage();
    if (++num_added % ask_every == 0) Take(run, matcher);
  }
  run.stream.Flush();
  Take(run, matcher);
  run.Drain(true);
  return Lines(run.events);
}

std::size_t NumOf(const Texts& lines, const std::string& kind) {
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(),
                    [&](const std::string& line) { return line.rfind(kind, 0) == 0; }));
}

TEST(SensorStreamTiming, DriveHasEveryKindOfStep) {
  const Texts lines = EventsOf(FaultyDrive(), 1, 0);
  EXPECT_EQ(NumOf(lines, "notice"), 1u);
  EXPECT_EQ(NumOf(lines, "ambiguous"), 1u);
  EXPECT_EQ(NumOf(lines, "segment"), 2u);
  EXPECT_GT(NumOf(lines, "sweep"), 80u);
  EXPECT_EQ(lines.back(), "ended");
}

TEST(SensorStreamTiming, EventsDoNotDependOnHowOftenTheyAreAskedFor) {
  const SensorMessages messages = FaultyDrive();
  const Texts expected = EventsOf(messages, 1, 0);
  for (const int ask_every : {2, 7, 100, 100'000}) {
    EXPECT_EQ(EventsOf(messages, ask_every, 0), expected) << "every " << ask_every << " messages";
  }
}

TEST(SensorStreamTiming, EventsDoNotDependOnHowFastScansAreMatched) {
  const SensorMessages messages = FaultyDrive();
  const Texts expected = EventsOf(messages, 1, 0);
  for (const int match_messages : {1, 8, 40, 300, 100'000}) {
    EXPECT_EQ(EventsOf(messages, 1, match_messages), expected)
        << "a match takes " << match_messages << " messages";
    EXPECT_EQ(EventsOf(messages, 5, match_messages), expected)
        << "a match takes " << match_messages << " messages, asked every fifth";
  }
}

}  // namespace
}  // namespace lio
