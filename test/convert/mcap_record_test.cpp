// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/mcap_record.hpp"

#include <gtest/gtest.h>

#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::RosBytes;

class McapRecordTest : public testing::Test {
 protected:
  FileSpan Source(const std::vector<std::uint8_t>& bytes) {
    file_ = std::ifstream(dir_.Write("records", std::string(bytes.begin(), bytes.end())),
                          std::ios::binary);
    return FileSpan(file_, bytes.size());
  }

  test::TempDir dir_;
  std::ifstream file_;
};

TEST_F(McapRecordTest, HasOpcodeAndLength) {
  const RosBytes record = RosBytes().Put(std::uint8_t{0x05}).Put(std::uint64_t{1} << 60);
  McapRecord read;
  auto source = Source(record.bytes());
  EXPECT_EQ(ReadMcapRecord(source, read), RecordStatus::kOk);
  EXPECT_EQ(read.op, McapOp::kMessage);
  EXPECT_EQ(read.content_bytes, std::uint64_t{1} << 60);
  EXPECT_EQ(ReadMcapRecord(source, read), RecordStatus::kEnd);
  auto cut = Source({0x05, 1, 2});
  EXPECT_EQ(ReadMcapRecord(cut, read), RecordStatus::kCut);
  auto zeros = Source(std::vector<std::uint8_t>(9));
  EXPECT_EQ(ReadMcapRecord(zeros, read), RecordStatus::kBroken);
}

TEST_F(McapRecordTest, AMessageHasChannelAndLogTime) {
  RosBytes content;
  content.Put(std::uint16_t{7}).Put(std::uint32_t{1}).Put(std::uint64_t{99}).Put(std::uint64_t{5});
  auto source = Source(content.bytes());
  const auto header = ReadMcapMessageHeader(source);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->channel, 7);
  EXPECT_EQ(header->log_time_ns, 99u);
  EXPECT_EQ(source.num_delivered(), kMcapMessageHeaderBytes);
  EXPECT_FALSE(ReadMcapMessageHeader(source));
}

TEST_F(McapRecordTest, AChunkSaysHowItIsStored) {
  RosBytes content;
  content.Put(std::uint64_t{1}).Put(std::uint64_t{2}).Put(std::uint64_t{3000});
  content.Put(std::uint32_t{0xdead}).PutString("zstd").Put(std::uint64_t{40}).Put('r');
  auto source = Source(content.bytes());
  const auto header = ReadMcapChunkHeader(source);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->inflated_bytes, 3000u);
  EXPECT_EQ(header->inflated_crc, 0xdeadu);
  EXPECT_EQ(header->compression, "zstd");
  EXPECT_EQ(header->stored_bytes, 40u);
  EXPECT_EQ(source.left(), 1u);
  for (std::size_t size = 0; size < content.bytes().size() - 1; ++size) {
    auto cut = Source(
        {content.bytes().begin(), content.bytes().begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_FALSE(ReadMcapChunkHeader(cut)) << size;
  }
}

TEST_F(McapRecordTest, TheChecksumIsThatOfZipFiles) {
  const std::string check = "123456789";
  auto source = Source({check.begin(), check.end()});
  EXPECT_EQ(Crc32OfRest(source), 0xcbf43926u);  // the published check value of CRC-32
}

TEST_F(McapRecordTest, FooterAndStatisticsMustBeWhole) {
  RosBytes footer;
  footer.Put(std::uint64_t{11}).Put(std::uint64_t{22}).Put(std::uint32_t{33});
  ASSERT_TRUE(ParseMcapFooter(footer.bytes()));
  EXPECT_EQ(ParseMcapFooter(footer.bytes())->summary_start, 11u);
  EXPECT_EQ(ParseMcapFooter(footer.bytes())->summary_crc, 33u);
  EXPECT_FALSE(ParseMcapFooter(ByteView(footer.bytes()).first(19)));
  RosBytes statistics;
  statistics.Put(std::uint64_t{500}).Put(std::uint16_t{2}).Put(std::uint32_t{3});
  ASSERT_TRUE(ParseMcapStatistics(statistics.bytes()));
  EXPECT_EQ(ParseMcapStatistics(statistics.bytes())->num_messages, 500u);
  EXPECT_EQ(ParseMcapStatistics(statistics.bytes())->num_channels, 3u);
  EXPECT_FALSE(ParseMcapStatistics(ByteView(statistics.bytes()).first(13)));
}

}  // namespace
}  // namespace lio
