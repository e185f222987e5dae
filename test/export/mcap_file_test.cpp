// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/mcap_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "export/mcap_parts.hpp"
#include "lio/convert/bag_reader.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::McapCursor;
using test::McapPart;
using test::McapParts;

constexpr int kNumMessages = 3000;
constexpr std::size_t kMagicBytes = 8;

std::string MessageOf(int i) {
  return "{\"i\":" + std::to_string(i) + ",\"fill\":\"" + std::string(1000, 'x') + "\"}";
}

// Two topics of one type and one of another; the messages of a topic come in turn, every second
// from 10 s on.
std::string Written(const std::filesystem::path& path, McapCompression compression) {
  McapFile file(path, compression);
  const std::uint16_t topics[] = {file.AddTopic("/a", "lio.A", "{}"),
                                  file.AddTopic("/b", "lio.A", "{}"),
                                  file.AddTopic("/c", "lio.C", "{\"type\":\"object\"}")};
  for (int i = 0; i < kNumMessages; ++i) {
    const Timestamp time{(10 + i) * std::int64_t{1'000'000'000}};
    file.Write(topics[i % 3], time, {time.ns - 1}, MessageOf(i));
  }
  EXPECT_EQ(file.num_messages(), static_cast<std::uint64_t>(kNumMessages));
  file.Close();
  return test::ReadText(path);
}

class McapFileTest : public ::testing::TestWithParam<McapCompression> {
 protected:
  test::TempDir folder_;
  std::filesystem::path path_ = folder_.path() / "out.mcap";
};

TEST_P(McapFileTest, OurReaderGetsEveryMessageInOrderAndWithoutDamage) {
  (void)Written(path_, GetParam());
  const auto reader = OpenBag(path_);
  EXPECT_TRUE(reader->knows_all_topics());
  BagMessage message;
  int num = 0;
  for (; reader->Next(message); ++num) {
    ASSERT_EQ(std::string(message.data.begin(), message.data.end()), MessageOf(num));
    EXPECT_EQ(message.received.ns, (10 + num) * std::int64_t{1'000'000'000});
  }
  EXPECT_EQ(num, kNumMessages);
  EXPECT_FALSE(reader->damage().Any()) << reader->damage().first_reason;
  EXPECT_EQ(reader->topics().size(), 3U);
}

INSTANTIATE_TEST_SUITE_P(EachCompression, McapFileTest,
                         ::testing::Values(McapCompression::kNone, McapCompression::kLz4,
                                           McapCompression::kZstd));

// The summary of an uncompressed file, whose every offset is followed.
class McapSummary : public ::testing::Test {
 protected:
  McapSummary() {
    bytes_ = Written(folder_.path() / "out.mcap", McapCompression::kNone);
    for (const McapPart& part : McapParts(bytes_, kMagicBytes, bytes_.size() - kMagicBytes)) {
      by_op_[part.op].push_back(part);
    }
  }

  test::TempDir folder_;
  std::string bytes_;
  std::map<int, std::vector<McapPart>> by_op_;
};

TEST_F(McapSummary, BeginsAndEndsAsTheFormatWants) {
  EXPECT_EQ(bytes_.substr(0, kMagicBytes), "\x89MCAP0\r\n");
  EXPECT_EQ(bytes_.substr(bytes_.size() - kMagicBytes), "\x89MCAP0\r\n");
  EXPECT_EQ(by_op_[0x01].size(), 1U);
  EXPECT_EQ(by_op_[0x03].size(), 2U);  // schemas; those in chunks are not seen here
  EXPECT_EQ(by_op_[0x04].size(), 3U);
  EXPECT_EQ(by_op_[0x0F].size(), 1U);
  EXPECT_GE(by_op_[0x06].size(), 3U);
  EXPECT_EQ(by_op_[0x06].size(), by_op_[0x08].size());
}

TEST_F(McapSummary, FooterPointsToTheSummaryAndItsOffsets) {
  McapCursor footer(by_op_[0x02].front().content);
  const std::uint64_t summary = footer.Number(8);
  const std::uint64_t offsets = footer.Number(8);
  const auto crc = static_cast<std::uint32_t>(footer.Number(4));
  EXPECT_EQ(summary, by_op_[0x0F].front().end);
  EXPECT_EQ(offsets, by_op_[0x0E].front().begin);
  const std::size_t covered_end = by_op_[0x02].front().end - 4;
  EXPECT_EQ(crc, McapCrc(std::string_view(bytes_).substr(summary, covered_end - summary)));
  for (const McapPart& part : by_op_[0x0E]) {
    McapCursor group(part.content);
    const int op = static_cast<int>(group.Number(1));
    const std::uint64_t start = group.Number(8);
    const std::uint64_t length = group.Number(8);
    // A group is the op's records of the summary, all of them.
    std::size_t num = 0;
    for (const McapPart& record : McapParts(bytes_, start, start + length)) {
      EXPECT_EQ(record.op, op);
      ++num;
    }
    EXPECT_EQ(num, by_op_[op].size());
  }
}

TEST_F(McapSummary, StatisticsCountWhatIsThere) {
  McapCursor statistics(by_op_[0x0B].front().content);
  EXPECT_EQ(statistics.Number(8), static_cast<std::uint64_t>(kNumMessages));
  EXPECT_EQ(statistics.Number(2), 2U);
  EXPECT_EQ(statistics.Number(4), 3U);
  EXPECT_EQ(statistics.Number(4), 0U);
  EXPECT_EQ(statistics.Number(4), 0U);
  EXPECT_EQ(statistics.Number(4), by_op_[0x06].size());
  EXPECT_EQ(statistics.Number(8), 10'000'000'000U);
  EXPECT_EQ(statistics.Number(8), 10'000'000'000U + (kNumMessages - 1) * 1'000'000'000ULL);
  McapCursor counts(statistics.Text());
  for (std::uint64_t topic = 0; topic < 3; ++topic) {
    EXPECT_EQ(counts.Number(2), topic);
    EXPECT_EQ(counts.Number(8), static_cast<std::uint64_t>(kNumMessages / 3));
  }
  EXPECT_TRUE(statistics.is_at_end());
}

TEST_F(McapSummary, EveryMessageIsFoundByTheIndices) {
  int num_found = 0;
  for (const McapPart& part : by_op_[0x08]) {
    McapCursor index(part.content);
    const std::uint64_t begin_ns = index.Number(8);
    const std::uint64_t end_ns = index.Number(8);
    const std::uint64_t chunk_start = index.Number(8);
    const std::uint64_t chunk_length = index.Number(8);
    const McapPart chunk = McapParts(bytes_, chunk_start, chunk_start + chunk_length).at(0);
    ASSERT_EQ(chunk.op, 0x06);
    McapCursor head(chunk.content);
    EXPECT_EQ(head.Number(8), begin_ns);
    EXPECT_EQ(head.Number(8), end_ns);
    (void)head.Number(8);
    const auto crc = static_cast<std::uint32_t>(head.Number(4));
    EXPECT_EQ(head.Text(), "");
    const std::string_view records = head.Take(head.Number(8));
    EXPECT_EQ(crc, McapCrc(records));
    McapCursor places(index.Text());
    while (!places.is_at_end()) {
      const std::uint64_t topic = places.Number(2);
      const std::uint64_t place = places.Number(8);
      McapCursor at(std::string_view(bytes_).substr(place));
      ASSERT_EQ(at.Number(1), 0x07U);
      McapCursor entries(at.Take(at.Number(8)));
      EXPECT_EQ(entries.Number(2), topic);
      McapCursor pairs(entries.Text());
      while (!pairs.is_at_end()) {
        const std::uint64_t time_ns = pairs.Number(8);
        McapCursor record(records.substr(pairs.Number(8)));
        ASSERT_EQ(record.Number(1), 0x05U);
        McapCursor message(record.Take(record.Number(8)));
        EXPECT_EQ(message.Number(2), topic);
        (void)message.Number(4);
        EXPECT_EQ(message.Number(8), time_ns);
        EXPECT_TRUE(begin_ns <= time_ns && time_ns <= end_ns);
        ++num_found;
      }
    }
  }
  EXPECT_EQ(num_found, kNumMessages);
}

TEST(McapCrc, IsThatOfZip) {
  EXPECT_EQ(McapCrc("123456789"), 0xcbf43926U);
}

}  // namespace
}  // namespace lio
