// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/mcap_summary.hpp"

#include <gtest/gtest.h>

#include "support/mcap_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

class McapSummaryTest : public testing::Test {
 protected:
  std::string Sound(const test::McapWriter::Options& options) {
    const auto path = dir_.path() / "sound.mcap";
    test::McapWriter writer(path, options);
    for (int i = 0; i < 5; ++i) writer.Write("/a", "a/B", Timestamp{i}, {1}, "float64 x");
    writer.Close();
    return test::ReadText(path);
  }
  McapSummary Read(const std::string& bytes) {
    std::ifstream file(dir_.Write("read.mcap", bytes), std::ios::binary);
    topics_ = McapTopics();
    return ReadMcapSummary(file, bytes.size(), topics_);
  }

  test::TempDir dir_;
  McapTopics topics_;
};

TEST_F(McapSummaryTest, GivesTopicsAndCounts) {
  const McapSummary summary = Read(Sound({}));
  EXPECT_TRUE(summary.has_footer);
  EXPECT_FALSE(summary.is_damaged);
  ASSERT_TRUE(summary.statistics);
  EXPECT_EQ(summary.statistics->num_messages, 5u);
  ASSERT_EQ(topics_.topics().size(), 1u);
  EXPECT_EQ(topics_.topics()[0].definition, "float64 x");
}

TEST_F(McapSummaryTest, MayBeAbsentAndTheFooterToo) {
  test::McapWriter::Options options;
  options.with_summary = false;
  const std::string bytes = Sound(options);
  EXPECT_TRUE(Read(bytes).has_footer);
  EXPECT_FALSE(Read(bytes).is_damaged);
  EXPECT_FALSE(Read(bytes).statistics);
  for (const std::size_t size : {std::size_t{8}, std::size_t{40}, bytes.size() - 1}) {
    EXPECT_FALSE(Read(bytes.substr(0, size)).has_footer) << size;
  }
}

TEST_F(McapSummaryTest, IsDamagedWhereItsChecksumOrItsPlaceIsWrong) {
  const std::string sound = Sound({});
  std::string flipped = sound;
  flipped[flipped.size() - 60] ^= 1;
  EXPECT_TRUE(Read(flipped).is_damaged);
  EXPECT_TRUE(topics_.topics().empty());
  std::string moved = sound;
  moved[moved.size() - 8 - 20 + 5] = 1;  // a start of 2^40
  EXPECT_TRUE(Read(moved).is_damaged);
}

TEST_F(McapSummaryTest, WithoutChecksumARecordThatLeavesItIsDamage) {
  test::McapWriter::Options options;
  options.with_crc = false;
  std::string bytes = Sound(options);
  const std::size_t statistics = bytes.rfind(std::string("\x0b\x2e\0\0\0\0\0\0\0", 9));
  ASSERT_NE(statistics, std::string::npos);
  bytes[statistics + 1] = '\x7f';
  const McapSummary summary = Read(bytes);
  EXPECT_TRUE(summary.is_damaged);
  EXPECT_FALSE(summary.statistics);
}

}  // namespace
}  // namespace lio
