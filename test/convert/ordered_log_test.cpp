// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/ordered_log.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

Timestamp StampOfLog(double seconds) {
  return Timestamp{1'000'000'000'000} + Duration::FromSeconds(seconds);
}

struct Written {
  std::int64_t utime;
  int id;
};

std::vector<Written> ReadEvents(const std::filesystem::path& path) {
  EventLogReader reader(path);
  std::vector<Written> events;
  LogEvent event;
  while (reader.Next(event)) {
    events.push_back({event.utime, event.data[0] + 256 * event.data[1]});
  }
  EXPECT_EQ(reader.skipped_bytes(), 0);
  return events;
}

Bytes Id(int id) {
  return {static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id / 256)};
}

TEST(OrderedLog, SortsWhatComesALittleOutOfOrder) {
  const test::TempDir dir;
  OrderedLog log(dir.path() / "a.lcm");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> earlier(0.0, 0.9);
  for (int i = 0; i < 2000; ++i)
    log.Add(StampOfLog(0.01 * i - earlier(random)), kScanChannel, Id(i));
  log.Close();
  const auto events = ReadEvents(dir.path() / "a.lcm");
  ASSERT_EQ(events.size(), 2000u);
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_GE(events[i].utime, events[i - 1].utime);
  }
  EXPECT_EQ(log.num_late(), 0);
  EXPECT_EQ(log.num_events(), 2000);
}

TEST(OrderedLog, KeepsArrivalOrderOnTies) {
  const test::TempDir dir;
  OrderedLog log(dir.path() / "a.lcm");
  log.Add(StampOfLog(1.0), kImuChannel, Id(0));
  log.Add(StampOfLog(0.5), kImuChannel, Id(1));
  for (int i = 2; i < 50; ++i) log.Add(StampOfLog(1.0), i % 2 ? kImuChannel : kScanChannel, Id(i));
  log.Add(StampOfLog(1.0 + 9e-7), kImuChannel, Id(50));  // the same microsecond
  log.Close();
  const auto events = ReadEvents(dir.path() / "a.lcm");
  ASSERT_EQ(events.size(), 51u);
  EXPECT_EQ(events[0].id, 1);
  EXPECT_EQ(events[1].id, 0);
  for (int i = 2; i < 51; ++i) EXPECT_EQ(events[static_cast<std::size_t>(i)].id, i);
}

TEST(OrderedLog, StaysOrderedWhenAnEventIsTooLate) {
  const test::TempDir dir;
  OrderedLog log(dir.path() / "a.lcm");
  for (int i = 0; i < 100; ++i) log.Add(StampOfLog(0.1 * i), kImuChannel, Id(i));
  log.Add(StampOfLog(0.0), kScanChannel, Id(100));
  log.Close();
  EXPECT_EQ(log.num_late(), 1);
  const auto events = ReadEvents(dir.path() / "a.lcm");
  ASSERT_EQ(events.size(), 101u);
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_GE(events[i].utime, events[i - 1].utime);
  }
}

TEST(OrderedLog, WritesWhileItGoes) {
  const test::TempDir dir;
  const auto path = dir.path() / "a.lcm";
  OrderedLog log(path);
  for (int i = 0; i < 1000; ++i) log.Add(StampOfLog(0.1 * i), kScanChannel, Bytes(60'000));
  // The log has 100 s with 60 kB every 100 ms, of which at most 2 s are held back.
  EXPECT_GT(std::filesystem::file_size(path), 50'000'000u);
}

}  // namespace
}  // namespace lio
