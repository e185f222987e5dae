// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/rosbag1_record.hpp"

#include <gtest/gtest.h>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

std::string Number32(std::uint32_t value) {
  return std::string(reinterpret_cast<const char*>(&value), 4);
}

std::string Field(const std::string& text) {
  return Number32(static_cast<std::uint32_t>(text.size())) + text;
}

std::string Record(const std::string& header, const std::string& data) {
  return Number32(static_cast<std::uint32_t>(header.size())) + header +
         Number32(static_cast<std::uint32_t>(data.size())) + data;
}

class RosbagRecord : public testing::Test {
 protected:
  RecordStatus Read(const std::string& bytes, RecordHeader& header) {
    std::ifstream file(dir_.Write("records", bytes), std::ios::binary);
    FileSpan span(file, bytes.size());
    return ReadRecordHeader(span, header);
  }
  test::TempDir dir_;
};

TEST_F(RosbagRecord, GivesTheFieldsOfAMessage) {
  const std::string bytes = Record(Field(std::string("op=\x02", 4)) + Field("conn=" + Number32(3)) +
                                       Field("time=" + Number32(10) + Number32(500)),
                                   "data!");
  RecordHeader header;
  ASSERT_EQ(Read(bytes, header), RecordStatus::kOk);
  EXPECT_EQ(header.op, RecordOp::kMessage);
  EXPECT_EQ(header.connection, 3u);
  EXPECT_EQ(header.time, Timestamp{10'000'000'500});
  EXPECT_EQ(header.data_bytes, 5u);
}

TEST_F(RosbagRecord, TellsEndCutAndNonsenseApart) {
  RecordHeader header;
  const std::string good = Record(Field(std::string("op=\x02", 4)), "");
  EXPECT_EQ(Read("", header), RecordStatus::kEnd);
  for (std::size_t cut = 1; cut < good.size(); ++cut) {
    EXPECT_EQ(Read(good.substr(0, cut), header), RecordStatus::kCut) << cut;
  }
  EXPECT_EQ(Read(Number32(0xffffffff) + good, header), RecordStatus::kBroken);
  EXPECT_EQ(Read(Record("no fields at all", ""), header), RecordStatus::kBroken);
  EXPECT_EQ(Read(Record(Field("topic=/a"), ""), header), RecordStatus::kBroken);
  EXPECT_EQ(Read(Record(Field(std::string("op=\x42", 4)), ""), header), RecordStatus::kBroken);
}

TEST_F(RosbagRecord, DropsNumbersOfAWrongSize) {
  RecordHeader header;
  const std::string bytes =
      Record(Field(std::string("op=\x02", 4)) + Field("conn=1") + Field("time=" + Number32(1)), "");
  ASSERT_EQ(Read(bytes, header), RecordStatus::kOk);
  EXPECT_FALSE(header.connection);
  EXPECT_FALSE(header.time);
}

TEST_F(RosbagRecord, DataIsNotAllocatedBeforeItArrives) {
  const std::string bytes = "short";
  std::ifstream file(dir_.Write("records", bytes), std::ios::binary);
  FileSpan span(file, bytes.size());
  std::vector<std::uint8_t> data;
  EXPECT_FALSE(ReadRecordData(span, 0xffffffff, data));
  EXPECT_EQ(data.size(), 5u);
  EXPECT_LE(data.capacity(), 2u << 20);
}

}  // namespace
}  // namespace lio
