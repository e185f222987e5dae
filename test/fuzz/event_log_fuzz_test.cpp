// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Feeds damaged logs to the reader: it must end, stay inside the file and account for every byte.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "lio/io/event_log.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr int kNumLogMutants = 1000;
constexpr std::int64_t kHeaderBytes = 28;

TEST(EventLogFuzz, EveryByteOfADamagedLogIsReadOrCounted) {
  const test::TempDir folder;
  const auto path = folder.path() / "log.lcm";
  {
    EventLogWriter writer(path);
    for (int i = 0; i < 20; ++i) writer.Write(i, "LIO_IMU", std::vector<std::uint8_t>(i * 7, 1));
  }
  std::ifstream file(path, std::ios::binary);
  const std::string sound{std::istreambuf_iterator<char>(file), {}};
  std::mt19937 random(7);
  int num_skipping = 0;
  for (int i = 0; i < kNumLogMutants; ++i) {
    std::string mutant = sound;
    for (auto rounds = 1 + random() % 5; rounds > 0; --rounds) {
      mutant[random() % mutant.size()] = static_cast<char>(random());
      if (random() % 4 == 0) mutant.erase(random() % mutant.size(), random() % 40);
      if (random() % 4 == 0) mutant.insert(random() % mutant.size(), random() % 40, '\xed');
    }
    std::ofstream(path, std::ios::binary) << mutant;
    EventLogReader reader(path);
    LogEvent event;
    std::int64_t read_bytes = 0;
    while (reader.Next(event)) {
      read_bytes += kHeaderBytes + std::ssize(event.channel) + std::ssize(event.data);
    }
    ASSERT_EQ(read_bytes + reader.skipped_bytes(), std::ssize(mutant)) << "mutant " << i;
    num_skipping += reader.skipped_bytes() > 0 ? 1 : 0;
  }
  EXPECT_GT(num_skipping, kNumLogMutants / 4);
}

}  // namespace
}  // namespace lio
