// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/mcap_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "convert/numbered_messages.hpp"
#include "lio/convert/ros_cursor.hpp"
#include "lio/io/input_error.hpp"
#include "support/build_paths.hpp"
#include "support/mcap_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::kNumNumbered;
using test::McapWriter;
using test::NumberedPayload;
using test::ReadBack;
using test::ReceivedAt;
using ::testing::HasSubstr;

// All is right if each message is one of those written, later than the one before.
ReadBack ReadMcap(const std::filesystem::path& path) {
  const auto bag = OpenMcap(path);
  ReadBack result;
  int next = 0;
  for (BagMessage message; bag->Next(message); ++result.num) {
    while (next < kNumNumbered && ReceivedAt(next) < message.received) ++next;
    const std::vector<std::uint8_t> expected = NumberedPayload(next);
    result.all_right &= message.received == ReceivedAt(next) &&
                        std::ranges::equal(message.data, expected) &&
                        bag->topics()[message.topic].name == (next % 2 == 0 ? "/even" : "/odd");
  }
  result.damage = bag->damage();
  return result;
}

class McapReaderTest : public testing::TestWithParam<std::string> {
 protected:
  McapWriter::Options Options() const {
    if (GetParam() == "unchunked") return {.compression = "", .chunk_bytes = 0};
    return {.compression = GetParam() == "plain" ? "" : GetParam(), .chunk_bytes = 5000};
  }
  void Write(const McapWriter::Options& options, bool is_closed = true) {
    McapWriter writer(file_, options);
    for (int i = 0; i < kNumNumbered; ++i) {
      writer.Write(i % 2 == 0 ? "/even" : "/odd", i % 2 == 0 ? "a/Even" : "a/Odd", ReceivedAt(i),
                   NumberedPayload(i), "float64 x");
    }
    is_closed ? writer.Close() : writer.FlushChunk();
  }

  test::TempDir dir_;
  std::filesystem::path file_ = dir_.path() / "test.mcap";
};

TEST_P(McapReaderTest, GivesEveryMessageInOrder) {
  Write(Options());
  const ReadBack read = ReadMcap(file_);
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_FALSE(read.damage.Any()) << read.damage.first_reason;
  EXPECT_EQ(read.damage.lost_bytes, 0);
}

TEST_P(McapReaderTest, KnowsTopicsFromTheSummaryBeforeReading) {
  Write(Options());
  const auto bag = OpenMcap(file_);
  EXPECT_TRUE(bag->knows_all_topics());
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[1].name, "/odd");
  EXPECT_EQ(bag->topics()[1].type, "a/Odd");
  EXPECT_EQ(bag->topics()[1].definition, "float64 x");
}

TEST_P(McapReaderTest, GivesSelectedTopicsOnlyAndCountsAll) {
  Write(Options());
  const auto bag = OpenMcap(file_);
  bag->Select([](const BagTopic& topic) { return topic.name == "/odd"; });
  BagMessage message;
  int num = 0;
  for (; bag->Next(message); ++num) EXPECT_EQ(bag->topics()[message.topic].name, "/odd");
  EXPECT_EQ(num, kNumNumbered / 2);
  EXPECT_EQ(bag->topics()[0].num_messages, kNumNumbered / 2);
  EXPECT_EQ(bag->begin_time(), ReceivedAt(0));
  EXPECT_EQ(bag->position_bytes(), bag->size_bytes());
}

TEST_P(McapReaderTest, NeedsNeitherSummaryNorChecksums) {
  auto options = Options();
  options.with_summary = false;
  options.with_crc = false;
  Write(options);
  const ReadBack read = ReadMcap(file_);
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_FALSE(read.damage.Any()) << read.damage.first_reason;
  EXPECT_FALSE(OpenMcap(file_)->knows_all_topics());
}

TEST_P(McapReaderTest, AFileThatItsRecorderNeverClosedIsReadWholly) {
  Write(Options(), false);
  const ReadBack read = ReadMcap(file_);
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_TRUE(read.damage.not_closed);
  EXPECT_FALSE(read.damage.cut_short);
  EXPECT_EQ(read.damage.lost_bytes, 0);
}

TEST_P(McapReaderTest, GivesEverythingBeforeACutAndSaysWhatIsLost) {
  Write(Options());
  const std::string whole = test::ReadText(file_);
  const std::size_t data_end = whole.rfind(std::string("\x0f\x04\0\0\0\0\0\0\0", 9));
  ASSERT_NE(data_end, std::string::npos);
  int num_before = 0;
  for (std::size_t cut = 8; cut < data_end; cut += 1511) {
    const ReadBack read = ReadMcap(dir_.Write("cut.mcap", whole.substr(0, cut)));
    EXPECT_TRUE(read.all_right) << cut;
    EXPECT_GE(read.num, num_before) << cut;
    EXPECT_TRUE(read.damage.not_closed) << cut;
    EXPECT_EQ(read.damage.cut_short, read.damage.lost_bytes > 0) << cut;
    EXPECT_LE(read.damage.lost_bytes, 12'000) << cut << ": more than a chunk";
    num_before = read.num;
  }
  EXPECT_GE(num_before, kNumNumbered - 20);
}

TEST_P(McapReaderTest, NothingOfADamagedChunkIsTakenForSound) {
  Write(Options());
  std::string bytes = test::ReadText(file_);
  for (std::size_t i = bytes.size() / 3; i < bytes.size() / 3 + 40; ++i) bytes[i] ^= 0x55;
  const ReadBack read = ReadMcap(dir_.Write("broken.mcap", bytes));
  if (GetParam() == "unchunked") return;  // nothing is checked there
  EXPECT_TRUE(read.all_right);
  EXPECT_LT(read.num, kNumNumbered);
  EXPECT_GT(read.num, kNumNumbered - 30);
  EXPECT_EQ(read.damage.num_chunks_damaged, 1);
  EXPECT_EQ(read.damage.num_messages_missing, kNumNumbered - read.num);
  EXPECT_GT(read.damage.lost_bytes, 0);
  EXPECT_FALSE(read.damage.cut_short);
  EXPECT_THAT(read.damage.first_reason, HasSubstr("checksum is wrong"));
}

TEST_P(McapReaderTest, AChunkWithoutChecksumIsReadUpToItsDamage) {
  auto options = Options();
  options.with_crc = false;
  Write(options);
  std::string bytes = test::ReadText(file_);
  for (std::size_t i = bytes.size() / 3; i < bytes.size() / 3 + 40; ++i) bytes[i] ^= 0x55;
  const ReadBack read = ReadMcap(dir_.Write("broken.mcap", bytes));
  EXPECT_GE(read.num, kNumNumbered - 30);
  if (GetParam() != "zstd") return;  // the content may look sound
  EXPECT_LT(read.num, kNumNumbered);
  EXPECT_EQ(read.damage.num_chunks_damaged, 1);
  EXPECT_GT(read.damage.lost_bytes, 0);
}

TEST_P(McapReaderTest, ADamagedSummaryIsNotBelieved) {
  Write(Options());
  std::string bytes = test::ReadText(file_);
  bytes[bytes.rfind("/odd")] = '!';
  const ReadBack read = ReadMcap(dir_.Write("summary.mcap", bytes));
  EXPECT_EQ(read.num, kNumNumbered);
  EXPECT_TRUE(read.all_right);
  EXPECT_TRUE(read.damage.Any());
  EXPECT_THAT(read.damage.first_reason, HasSubstr("summary"));
}

// The file was written by @mcap/core 2.2.2 of npm with test/convert/data/mcap_core.mjs.
TEST(McapOfOthers, FromTheFormatsOwnLibraryIsRead) {
  const auto bag = OpenMcap(test::SourceDir() + "/test/convert/data/mcap_core.mcap");
  EXPECT_TRUE(bag->knows_all_topics());
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[1].type, "std_msgs/UInt16");
  EXPECT_EQ(bag->topics()[1].definition, "uint16 data\n");
  int num = 0;
  for (BagMessage message; bag->Next(message); ++num) {
    const BagTopic& topic = bag->topics()[message.topic];
    EXPECT_EQ(message.received, ReceivedAt(num));
    EXPECT_EQ(topic.name, num % 2 == 0 ? "/byte" : "/uint16");
    RosCursor value(message.data, topic.encoding);
    EXPECT_EQ(num % 2 == 0 ? value.Read<std::uint8_t>() : value.Read<std::uint16_t>(), num);
    EXPECT_TRUE(value.AtEnd());
  }
  EXPECT_EQ(num, 100);
  EXPECT_FALSE(bag->damage().Any()) << bag->damage().first_reason;
}

INSTANTIATE_TEST_SUITE_P(Storages, McapReaderTest,
                         testing::Values("unchunked", "plain", "lz4", "zstd"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lio
