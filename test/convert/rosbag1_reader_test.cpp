// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "convert/numbered_messages.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/io/input_error.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::Bag1Writer;
using test::kNumNumbered;
using test::NumberedPayload;
using test::ReadBack;

Timestamp ReceivedLongAgo(int i) {
  return Timestamp{1'000'000'000'000 + i * 10'000'000};
}

void WriteBag(const std::filesystem::path& path, const Bag1Writer::Options& options) {
  Bag1Writer writer(path, options);
  for (int i = 0; i < kNumNumbered; ++i) {
    writer.Write(i % 2 == 0 ? "/even" : "/odd", i % 2 == 0 ? "a/Even" : "a/Odd", ReceivedLongAgo(i),
                 NumberedPayload(i), "float64 x");
  }
  writer.Close();
}

// All is right if each message is the next one of those written.
ReadBack ReadRosbag1(const std::filesystem::path& path) {
  const auto bag = OpenRosbag1(path);
  ReadBack result;
  BagMessage message;
  while (bag->Next(message)) {
    const auto expected = NumberedPayload(result.num);
    const std::string topic = result.num % 2 == 0 ? "/even" : "/odd";
    result.all_right &=
        message.received == ReceivedLongAgo(result.num) &&
        std::equal(message.data.begin(), message.data.end(), expected.begin(), expected.end()) &&
        bag->topics()[message.topic].name == topic;
    ++result.num;
  }
  result.damage = bag->damage();
  return result;
}

class Rosbag1 : public testing::TestWithParam<std::string> {
 protected:
  Bag1Writer::Options Options() const {
    return {.compression = GetParam(), .chunk_bytes = 5000, .with_index = true};
  }
  test::TempDir dir_;
  std::filesystem::path bag_ = dir_.path() / "test.bag";
};

TEST_P(Rosbag1, GivesEveryMessageInOrder) {
  WriteBag(bag_, Options());
  const ReadBack read = ReadRosbag1(bag_);
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_FALSE(read.damage.Any()) << read.damage.first_reason;
}

TEST_P(Rosbag1, KnowsTopicsFromTheIndexBeforeReading) {
  WriteBag(bag_, Options());
  const auto bag = OpenRosbag1(bag_);
  EXPECT_TRUE(bag->knows_all_topics());
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[1].name, "/odd");
  EXPECT_EQ(bag->topics()[1].type, "a/Odd");
  EXPECT_EQ(bag->topics()[1].definition, "float64 x");
}

TEST_P(Rosbag1, GivesSelectedTopicsOnlyAndCountsAll) {
  WriteBag(bag_, Options());
  const auto bag = OpenRosbag1(bag_);
  bag->Select([](const BagTopic& topic) { return topic.name == "/odd"; });
  BagMessage message;
  int num = 0;
  while (bag->Next(message)) {
    EXPECT_EQ(bag->topics()[message.topic].name, "/odd");
    ++num;
  }
  EXPECT_EQ(num, kNumNumbered / 2);
  EXPECT_EQ(bag->topics()[0].num_messages, kNumNumbered / 2);
  EXPECT_EQ(bag->begin_time(), ReceivedLongAgo(0));
  EXPECT_EQ(bag->position_bytes(), bag->size_bytes());
}

TEST_P(Rosbag1, NeedsNoIndexButSaysItIsMissing) {
  auto options = Options();
  options.with_index = false;
  WriteBag(bag_, options);
  const ReadBack read = ReadRosbag1(bag_);
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_TRUE(read.damage.not_closed);
  EXPECT_FALSE(read.damage.cut_short);
  EXPECT_EQ(read.damage.lost_bytes, 0);
}

TEST_P(Rosbag1, GivesEverythingBeforeACutAndSaysWhatIsMissing) {
  WriteBag(bag_, Options());
  const std::string whole = test::ReadText(bag_);
  int num_before = 0;
  constexpr std::size_t kHeaderEnd = 13 + 4096;
  for (std::size_t cut = kHeaderEnd; cut < whole.size(); cut += 1511) {
    const ReadBack read = ReadRosbag1(dir_.Write("cut.bag", whole.substr(0, cut)));
    EXPECT_TRUE(read.all_right) << cut;
    EXPECT_GE(read.num, num_before) << cut;
    EXPECT_TRUE(read.damage.cut_short) << cut;
    EXPECT_FALSE(read.damage.first_reason.empty()) << cut;
    num_before = read.num;
    // The missing bytes up to the index are lost, and at most the piece that was cut.
    EXPECT_TRUE(read.num >= kNumNumbered - 30 || read.damage.lost_bytes > 0) << cut;
  }
  EXPECT_GE(num_before, kNumNumbered - 10);
}

TEST_P(Rosbag1, PassesOverAChunkWithBrokenContent) {
  WriteBag(bag_, Options());
  std::string bytes = test::ReadText(bag_);
  const std::size_t third = bytes.size() / 3;
  for (std::size_t i = third; i < third + 40; ++i) bytes[i] = static_cast<char>(0xff);
  const auto bag = OpenRosbag1(dir_.Write("broken.bag", bytes));
  BagMessage message;
  int num = 0;
  while (bag->Next(message)) ++num;
  if (GetParam() == "none") {
    // Only the messages to which the damaged bytes belong are lost.
    EXPECT_GE(num, kNumNumbered - 30);
  } else {
    EXPECT_LT(num, kNumNumbered);
    EXPECT_GT(num, kNumNumbered / 2);
    EXPECT_EQ(bag->damage().num_chunks_damaged, 1);
    EXPECT_GT(bag->damage().lost_bytes, 0);
  }
  EXPECT_FALSE(bag->damage().cut_short);
}

TEST_P(Rosbag1, SurvivesRandomMutations) {
  WriteBag(bag_, Options());
  const std::string whole = test::ReadText(bag_);
  std::mt19937 random(11);
  for (int round = 0; round < 100; ++round) {
    std::string bytes = whole;
    const auto num_changes = 1 + random() % 4;
    for (unsigned i = 0; i < num_changes; ++i) {
      bytes[13 + random() % (bytes.size() - 13)] = static_cast<char>(random());
    }
    const auto bag = OpenRosbag1(dir_.Write("mutated.bag", bytes));
    BagMessage message;
    int num = 0;
    while (bag->Next(message)) ++num;
    EXPECT_LE(num, kNumNumbered + 4) << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Compressions, Rosbag1, testing::Values("none", "lz4", "bz2"),
                         [](const auto& test) { return test.param; });

TEST(Rosbag1File, OfAnotherKindIsRefused) {
  const test::TempDir dir;
  EXPECT_THROW((void)OpenRosbag1(dir.Write("a.bag", "")), InputError);
  EXPECT_THROW((void)OpenRosbag1(dir.Write("b.bag", "#ROSBAG V1.2\nwhatever")), InputError);
  EXPECT_THROW((void)OpenBag(dir.path() / "none.bag"), InputError);
}

TEST(Rosbag1File, LeftOpenByItsRecorderGivesItsLastChunk) {
  // The recorder writes a chunk's header with size 0 and returns to it when the chunk is full.
  const test::TempDir dir;
  for (const std::string compression : {"none", "lz4"}) {
    const auto path = dir.path() / ("open_" + compression + ".bag");
    WriteBag(path, {.compression = compression, .chunk_bytes = 5000, .with_index = false});
    std::string bytes = test::ReadText(path);
    const std::size_t last = bytes.rfind("compression=");
    const std::size_t header_begin = last - 4 - 8 - 4;  // field length, "op" field, header length
    std::uint32_t header_bytes = 0;
    std::memcpy(&header_bytes, bytes.data() + header_begin, 4);
    const std::size_t length_at = header_begin + 4 + header_bytes;
    for (std::size_t i = 0; i < 4; ++i) bytes[length_at + i] = 0;
    const ReadBack read = ReadRosbag1(dir.Write("open.bag", bytes));
    EXPECT_EQ(read.num, kNumNumbered) << compression;
    EXPECT_TRUE(read.all_right) << compression;
    EXPECT_TRUE(read.damage.not_closed);
  }
}

TEST(Rosbag1File, WithHostileLengthsEnds) {
  const test::TempDir dir;
  const auto path = dir.path() / "good.bag";
  WriteBag(path, {.compression = "none", .chunk_bytes = 5000, .with_index = true});
  const std::string whole = test::ReadText(path);
  // Every 32-bit length in the first chunks, aligned or not, is set to nearly 4 GB.
  for (std::size_t at = 4096 + 13; at < 4096 + 13 + 400; at += 3) {
    std::string bytes = whole;
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(i == 0 ? 0xf0 : 0xff);
    const auto bag = OpenRosbag1(dir.Write("hostile.bag", bytes));
    BagMessage message;
    while (bag->Next(message)) {
    }
  }
}

TEST(Rosbag1File, AMessageThatInflatesBeyondAnyCloudIsDamageAndNotKept) {
  const test::TempDir dir;
  const std::filesystem::path path = dir.path() / "bomb.bag";
  Bag1Writer writer(path, {.compression = "bz2", .chunk_bytes = 5000, .with_index = true});
  writer.Write("/small", "a/Small", ReceivedLongAgo(0), NumberedPayload(0), "float64 x");
  writer.Write("/huge", "a/Huge", ReceivedLongAgo(1), std::vector<std::uint8_t>(100 << 20),
               "float64 x");
  writer.Write("/small", "a/Small", ReceivedLongAgo(2), NumberedPayload(2), "float64 x");
  writer.Close();
  EXPECT_LT(std::filesystem::file_size(path), 100'000u);
  const auto bag = OpenRosbag1(path);
  BagMessage message;
  std::vector<Timestamp> received;
  while (bag->Next(message)) received.push_back(message.received);
  EXPECT_EQ(received, (std::vector{ReceivedLongAgo(0), ReceivedLongAgo(2)}));
  EXPECT_EQ(bag->damage().num_messages_damaged, 1);
}

TEST(Rosbag1File, NamesThatATerminalWouldObeyAreEscaped) {
  const test::TempDir dir;
  const std::filesystem::path path = dir.path() / "escape.bag";
  Bag1Writer writer(path);
  writer.Write("/velo\x1b[31m\nall is well", "a/B\x07", ReceivedLongAgo(0), NumberedPayload(0),
               "float64 x");
  writer.Close();
  const auto bag = OpenRosbag1(path);
  BagMessage message;
  ASSERT_TRUE(bag->Next(message));
  EXPECT_EQ(bag->topics()[0].name, "/velo\\x1b[31m\\nall is well");
  EXPECT_EQ(bag->topics()[0].type, "a/B\\x07");
}

}  // namespace
}  // namespace lio
