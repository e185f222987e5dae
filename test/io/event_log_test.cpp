// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/event_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <random>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kHeaderBytes = 28;
constexpr int kLengthAt = 24;  // the data length's place in the header

std::vector<std::uint8_t> Payload(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

// Makes a log of events on LIO_IMU and LIO_SCAN in turn, and its bytes, which tests damage.
class EventLogTest : public ::testing::Test {
 protected:
  static constexpr std::int64_t kDataBytes = 100;

  std::int64_t EventBytes(int number) const {
    return kHeaderBytes + (number % 2 == 0 ? 7 : 8) + kDataBytes;
  }
  std::int64_t EventAt(int number) const {
    std::int64_t at = 0;
    for (int i = 0; i < number; ++i) at += EventBytes(i);
    return at;
  }

  std::vector<std::uint8_t> WriteEvents(int count) {
    EventLogWriter writer(path_);
    for (int i = 0; i < count; ++i) {
      writer.Write(1000 + i, i % 2 == 0 ? "LIO_IMU" : "LIO_SCAN",
                   Payload(kDataBytes, static_cast<unsigned>(i)));
    }
    writer.Close();
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void Store(const std::vector<std::uint8_t>& bytes) {
    std::ofstream file(path_, std::ios::binary);
    for (const std::uint8_t byte : bytes) file.put(static_cast<char>(byte));
  }

  // Returns the numbers of the events that can be read; their contents are checked.
  std::vector<std::int64_t> ReadNumbers() {
    EventLogReader reader(path_);
    std::vector<std::int64_t> numbers;
    LogEvent event;
    while (reader.Next(event)) {
      numbers.push_back(event.number);
      EXPECT_EQ(event.utime, 1000 + event.number);
      EXPECT_EQ(event.channel, event.number % 2 == 0 ? "LIO_IMU" : "LIO_SCAN");
      EXPECT_EQ(event.data, Payload(kDataBytes, static_cast<unsigned>(event.number)));
    }
    skipped_bytes_ = reader.skipped_bytes();
    EXPECT_EQ(reader.position_bytes(), reader.size_bytes());
    return numbers;
  }

  test::TempDir folder_;
  std::filesystem::path path_ = folder_.path() / "events.lcm";
  std::int64_t skipped_bytes_ = -1;
};

TEST_F(EventLogTest, WhatIsWrittenIsRead) {
  WriteEvents(4);
  EXPECT_THAT(ReadNumbers(), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(skipped_bytes_, 0);
}

TEST_F(EventLogTest, LayoutIsLcmLoggers) {
  EventLogWriter writer(path_);
  writer.Write(0x0102030405060708, "AB", Payload(1, 3));
  writer.Close();
  std::ifstream file(path_, std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(bytes, ElementsAre(0xED, 0xA1, 0xDA, 0x01, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6,
                                 7, 8, 0, 0, 0, 2, 0, 0, 0, 1, 'A', 'B', Payload(1, 3)[0]));
}

TEST_F(EventLogTest, EmptyFileHoldsNoEvents) {
  Store({});
  EXPECT_THAT(ReadNumbers(), ElementsAre());
  EXPECT_EQ(skipped_bytes_, 0);
}

TEST_F(EventLogTest, BadSyncCostsThatEventOnly) {
  auto bytes = WriteEvents(4);
  bytes[EventAt(1)] ^= 0xff;
  Store(bytes);
  EXPECT_THAT(ReadNumbers(), ElementsAre(0, 2, 3));
  EXPECT_EQ(skipped_bytes_, EventBytes(1));
}

TEST_F(EventLogTest, HugeAndNegativeLengthsCostThatEventOnly) {
  for (const std::uint8_t top : {std::uint8_t{0x7f}, std::uint8_t{0xff}, std::uint8_t{0x80}}) {
    auto bytes = WriteEvents(4);
    bytes[EventAt(1) + kLengthAt] = top;
    Store(bytes);
    EXPECT_THAT(ReadNumbers(), ElementsAre(0, 2, 3)) << int{top};
    EXPECT_EQ(skipped_bytes_, EventBytes(1)) << int{top};
    for (int i = 1; i < 4; ++i) bytes[EventAt(1) + kLengthAt + i] = 0xff;
    Store(bytes);
    EXPECT_THAT(ReadNumbers(), ElementsAre(0, 2, 3)) << int{top};
    EXPECT_EQ(skipped_bytes_, EventBytes(1)) << int{top};
  }
}

TEST_F(EventLogTest, ALengthThatSwallowsLaterEventsCostsThatEventOnly) {
  auto bytes = WriteEvents(5);
  bytes[EventAt(1) + kLengthAt + 2] = 1;  // 256 bytes more: two events and a part of the third
  Store(bytes);
  EXPECT_THAT(ReadNumbers(), ElementsAre(0, 2, 3, 4));
  EXPECT_EQ(skipped_bytes_, EventBytes(1));
}

TEST_F(EventLogTest, BadChannelLengthCostsThatEventOnly) {
  for (const std::uint8_t length : {std::uint8_t{0}, std::uint8_t{50}, std::uint8_t{255}}) {
    auto bytes = WriteEvents(4);
    bytes[EventAt(1) + 23] = length;
    Store(bytes);
    EXPECT_THAT(ReadNumbers(), ElementsAre(0, 2, 3)) << int{length};
    EXPECT_EQ(skipped_bytes_, EventBytes(1)) << int{length};
  }
}

TEST_F(EventLogTest, GarbageBetweenEventsIsSkippedAndCounted) {
  auto bytes = WriteEvents(3);
  const auto garbage = Payload(3'000'000, 9);  // more than the reader's window
  bytes.insert(bytes.begin() + EventAt(1), garbage.begin(), garbage.end());
  Store(bytes);
  EXPECT_THAT(ReadNumbers(), ElementsAre(0, 1, 2));
  EXPECT_EQ(skipped_bytes_, 3'000'000);
}

TEST_F(EventLogTest, EveryCutKeepsTheWholeEventsBeforeIt) {
  const auto bytes = WriteEvents(3);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Store({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    int whole = 0;
    while (EventAt(whole + 1) <= static_cast<std::int64_t>(size)) ++whole;
    ASSERT_EQ(ReadNumbers().size(), static_cast<std::size_t>(whole)) << size;
    ASSERT_EQ(skipped_bytes_, static_cast<std::int64_t>(size) - EventAt(whole)) << size;
  }
}

TEST_F(EventLogTest, RandomDamageLosesNoUndamagedEvent) {
  const auto sound = WriteEvents(30);
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    auto bytes = sound;
    std::vector<std::int64_t> expected;
    for (int i = 0; i < 30; ++i) {
      if (random() % 4 == 0) {
        bytes[EventAt(i) + random() % 4] ^= static_cast<std::uint8_t>(1 + random() % 255);
      } else {
        expected.push_back(i);
      }
    }
    Store(bytes);
    ASSERT_EQ(ReadNumbers(), expected) << "round " << round;
  }
}

TEST_F(EventLogTest, ManyFalseHeadersAreReadInReasonableTime) {
  // The log has 100 000 headers that all claim the file up to the middle of the one sound event at
  // its end.
  constexpr std::size_t kFalseBytes = kHeaderBytes + 8;
  constexpr std::size_t kSoundAt = 100'000 * kFalseBytes + 3'000'000;
  const auto sound = WriteEvents(1);
  std::vector<std::uint8_t> bytes(kSoundAt);
  for (std::size_t at = 0; at < 100'000 * kFalseBytes; at += kFalseBytes) {
    std::copy_n(sound.begin(), kFalseBytes, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    const std::size_t length = kSoundAt + 10 - at - (kHeaderBytes + 7);
    for (int i = 0; i < 4; ++i) {
      bytes[at + kLengthAt + i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
    }
  }
  bytes.insert(bytes.end(), sound.begin(), sound.end());
  Store(bytes);
  EXPECT_THAT(ReadNumbers(), ElementsAre(0));
  EXPECT_EQ(skipped_bytes_, static_cast<std::int64_t>(kSoundAt));
}

TEST_F(EventLogTest, ReadingGoesOnFromAPlaceOfBefore) {
  auto bytes = WriteEvents(6);
  bytes[static_cast<std::size_t>(EventAt(2))] ^= 0xff;  // damage on the way
  Store(bytes);
  EventLogReader reader(path_);
  LogEvent event;
  ASSERT_TRUE(reader.Next(event));
  const std::int64_t position = reader.position_bytes();
  std::vector<std::int64_t> numbers;
  while (reader.Next(event)) numbers.push_back(event.number);
  EXPECT_THAT(numbers, ElementsAre(1, 3, 4, 5));
  reader.SeekTo(position);
  numbers.clear();
  while (reader.Next(event)) numbers.push_back(event.number);
  EXPECT_THAT(numbers, ElementsAre(1, 3, 4, 5));
  reader.SeekTo(-1);
  EXPECT_EQ(reader.position_bytes(), 0);
  reader.SeekTo(std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(reader.Next(event));
}

TEST_F(EventLogTest, MissingFilesAndFoldersAreNamed) {
  EXPECT_THROW(EventLogReader(folder_.path() / "missing.lcm"), std::runtime_error);
  EXPECT_THROW(EventLogReader{folder_.path()}, std::runtime_error);
  EXPECT_THROW(EventLogWriter(folder_.path() / "no_such_folder" / "log.lcm"), std::runtime_error);
}

}  // namespace
}  // namespace lio
