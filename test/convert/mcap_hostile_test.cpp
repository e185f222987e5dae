// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the MCAP reader files that no recorder writes: lengths of 2^63, decompression bombs, names
// that a terminal would obey. It must end, take little memory, and count what it left out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "convert/mcap_reader.hpp"
#include "lio/io/input_error.hpp"
#include "support/mcap_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::McapWriter;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Timestamp NthStamp(int i) {
  return Timestamp{1'600'000'000'000'000'000 + i};
}

std::int64_t PeakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

class McapHostile : public testing::Test {
 protected:
  std::vector<Timestamp> ReadAll(const std::filesystem::path& path) {
    const auto bag = OpenMcap(path);
    std::vector<Timestamp> received;
    for (BagMessage message; bag->Next(message);) received.push_back(message.received);
    damage_ = bag->damage();
    topics_ = bag->topics();
    return received;
  }

  test::TempDir dir_;
  std::filesystem::path file_ = dir_.path() / "test.mcap";
  BagDamage damage_;
  std::vector<BagTopic> topics_;
};

TEST_F(McapHostile, EveryLengthMayBeHuge) {
  McapWriter writer(file_, {.compression = "", .chunk_bytes = 150});
  for (int i = 0; i < 6; ++i) writer.Write("/a", "a/B", NthStamp(i), std::vector<std::uint8_t>(40));
  writer.Close();
  const std::string whole = test::ReadText(file_);
  for (const char byte : {'\x7f', '\xff'}) {
    for (std::size_t at = 8; at + 8 < whole.size(); at += 3) {
      std::string bytes = whole;
      for (std::size_t i = 0; i < 7; ++i) bytes[at + i] = '\xf0';
      bytes[at + 7] = byte;
      EXPECT_LE(ReadAll(dir_.Write("hostile.mcap", bytes)).size(), 6u) << at;
      EXPECT_TRUE(damage_.lost_bytes >= 0 && damage_.lost_bytes < 1'000'000'000) << at;
    }
  }
}

TEST_F(McapHostile, AMessageThatInflatesBeyondAnyCloudIsDamageAndNotKept) {
  for (const char* compression : {"lz4", "zstd"}) {
    McapWriter writer(file_, {.compression = compression, .chunk_bytes = 5000});
    writer.Write("/a", "a/B", NthStamp(0), {1});
    writer.Write("/a", "a/B", NthStamp(1), std::vector<std::uint8_t>(100 << 20));
    writer.Write("/a", "a/B", NthStamp(2), {3});
    writer.Close();
    EXPECT_LT(std::filesystem::file_size(file_), 1'000'000u);
    EXPECT_THAT(ReadAll(file_), ElementsAre(NthStamp(0), NthStamp(2))) << compression;
    EXPECT_EQ(damage_.num_messages_damaged, 1) << compression;
  }
}

// The chunk's header says 100 bytes.
TEST_F(McapHostile, AChunkThatInflatesToMoreThanItSaysIsLeft) {
  McapWriter writer(file_, {.compression = "zstd", .chunk_bytes = 5000, .with_crc = false});
  writer.Write("/a", "a/B", NthStamp(0), std::vector<std::uint8_t>(60 << 20));
  writer.Close();
  std::string bytes = test::ReadText(file_);
  const std::size_t chunk = bytes.find('\x06', 8);
  const std::uint64_t said = 100;
  std::memcpy(bytes.data() + chunk + 9 + 16, &said, sizeof said);
  const std::int64_t before = PeakBytes();
  EXPECT_TRUE(ReadAll(dir_.Write("bomb.mcap", bytes)).empty());
  EXPECT_EQ(damage_.num_chunks_damaged, 1);
  EXPECT_LT(PeakBytes() - before, 20 << 20);
}

TEST_F(McapHostile, UnknownRecordsArePassedOverAndUnknownCompressionIsNamed) {
  McapWriter writer(file_, {.compression = "snappy", .chunk_bytes = 1});
  writer.Write("/a", "a/B", NthStamp(0), {1});
  writer.Close();
  EXPECT_TRUE(ReadAll(file_).empty());
  EXPECT_THAT(damage_.first_reason, HasSubstr("unknown compression 'snappy'"));
  for (const std::size_t chunk_bytes : {0, 10'000}) {
    McapWriter other(file_, {.compression = "", .chunk_bytes = chunk_bytes});
    other.Write("/a", "a/B", NthStamp(0), {1});
    for (const int op : {0x09, 0x0c, 0x10, 0x80, 0xff}) {
      other.WriteRecord(static_cast<std::uint8_t>(op), {1, 2, 3});
    }
    other.Write("/a", "a/B", NthStamp(1), {1});
    other.Close();
    EXPECT_THAT(ReadAll(file_), ElementsAre(NthStamp(0), NthStamp(1)));
    EXPECT_FALSE(damage_.Any()) << damage_.first_reason;
  }
}

TEST_F(McapHostile, RecordsThatAreTooShortOrNameNoTopicAreCounted) {
  for (const std::size_t chunk_bytes : {0, 10'000}) {
    McapWriter writer(file_, {.compression = "", .chunk_bytes = chunk_bytes});
    writer.Write("/a", "a/B", NthStamp(0), {1});
    writer.WriteRecord(0x05, {1, 0});                            // a message without its header
    writer.WriteRecord(0x05, std::vector<std::uint8_t>(30, 9));  // belongs to channel 0x0909
    writer.WriteRecord(0x03, {1, 0, 4, 0, 0, 0, 'a'});           // a schema whose name is cut
    writer.Write("/a", "a/B", Timestamp{-1}, {1});               // in the year 2554
    writer.Write("/a", "a/B", NthStamp(1), {1});
    writer.Close();
    EXPECT_THAT(ReadAll(file_), ElementsAre(NthStamp(0), NthStamp(1))) << chunk_bytes;
    EXPECT_EQ(damage_.num_messages_damaged, 4) << chunk_bytes;
  }
}

TEST_F(McapHostile, NamesThatATerminalWouldObeyAreEscaped) {
  McapWriter writer(file_, {});
  writer.Write("/velo\x1b[31m\nall is well", "a/B\x07", NthStamp(0), {1});
  writer.Close();
  EXPECT_THAT(ReadAll(file_), ElementsAre(NthStamp(0)));
  EXPECT_EQ(topics_[0].name, "/velo\\x1b[31m\\nall is well");
  EXPECT_EQ(topics_[0].type, "a/B\\x07");
}

TEST_F(McapHostile, FilesOfAnotherKindAreRefused) {
  EXPECT_THROW((void)OpenMcap(dir_.Write("a.mcap", "")), InputError);
  EXPECT_THROW((void)OpenMcap(dir_.Write("b.mcap", "\x89MCAP1\r\n and more")), InputError);
  EXPECT_THROW((void)OpenBag(dir_.Write("c.mcap", "#ROSBAG V2.0\n")), InputError);
  EXPECT_TRUE(ReadAll(dir_.Write("d.mcap", "\x89MCAP0\r\n")).empty());
  EXPECT_TRUE(damage_.not_closed);
}

}  // namespace
}  // namespace lio
