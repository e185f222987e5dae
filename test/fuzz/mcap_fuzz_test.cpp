// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Feeds damaged MCAP files to the reader: it must end, give no message of a chunk whose checksum is
// wrong, and say that something is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "lio/convert/bag_reader.hpp"
#include "support/mcap_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr int kNumMcapMutants = 300;
constexpr int kNumMessages = 40;

std::vector<std::uint8_t> Payload(int i) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(i * 9), static_cast<std::uint8_t>(i));
}

class McapFuzz : public testing::TestWithParam<const char*> {
 protected:
  std::string SoundFile() {
    const auto path = dir_.path() / "sound.mcap";
    test::McapWriter writer(path, {.compression = GetParam(), .chunk_bytes = 900});
    for (int i = 0; i < kNumMessages; ++i) {
      writer.Write(i % 3 == 0 ? "/imu" : "/points", "a/B", Timestamp{i}, Payload(i), "float64 x");
    }
    writer.Close();
    return test::ReadText(path);
  }

  test::TempDir dir_;
};

TEST_P(McapFuzz, AnyDamageIsSurvivedAndTold) {
  const std::string sound = SoundFile();
  std::mt19937 random(7);
  int num_told = 0;
  for (int i = 0; i < kNumMcapMutants; ++i) {
    std::string mutant = sound;
    for (auto rounds = 1 + random() % 5; rounds > 0; --rounds) {
      mutant[8 + random() % (mutant.size() - 8)] = static_cast<char>(random());
      if (random() % 4 == 0) mutant.erase(8 + random() % (mutant.size() - 8), random() % 40);
      if (random() % 4 == 0) mutant.insert(8 + random() % (mutant.size() - 8), random() % 40, '\5');
    }
    const auto bag = OpenBag(dir_.Write("mutant.mcap", mutant));
    int num_wrong = 0;
    int num_read = 0;
    for (BagMessage message; bag->Next(message); ++num_read) {
      const std::int64_t number = message.received.ns;
      const bool is_right = number >= 0 && number < kNumMessages &&
                            std::ranges::equal(message.data, Payload(static_cast<int>(number)));
      num_wrong += is_right ? 0 : 1;
    }
    ASSERT_EQ(num_wrong, 0) << "mutant " << i;
    ASSERT_LE(num_read, kNumMessages) << "mutant " << i;
    ASSERT_TRUE(num_read == kNumMessages || bag->damage().Any()) << "mutant " << i;
    ASSERT_GE(bag->damage().lost_bytes, 0) << "mutant " << i;
    num_told += bag->damage().Any() ? 1 : 0;
  }
  EXPECT_GT(num_told, kNumMcapMutants * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Compressions, McapFuzz, testing::Values("", "lz4", "zstd"),
                         [](const auto& test) {
                           return *test.param == '\0' ? "none" : std::string(test.param);
                         });

}  // namespace
}  // namespace lio
