// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Feeds one million mutated messages to the decoders. The release build shows that nothing crashes
// or takes long; run it under sanitizers to see that no byte outside a message is touched:
//   cmake --preset asan && cmake --build build-asan --target lio_fuzz_test
//   build-asan/bin/lio_fuzz_test
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>

#include "lio/io/lcm_codec.hpp"

namespace lio {
namespace {

constexpr int kNumMessageMutants = 1'000'000;
constexpr std::size_t kScanFixedBytes = 44;
constexpr std::size_t kPointBytes = sizeof(LidarPoint);

// Draws are bounded by modulo, so that the seed gives the same ones on every standard library.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  std::size_t Below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }

  void Mutate(Bytes& bytes) {
    switch (Below(6)) {
      case 0:
        if (!bytes.empty()) bytes[Below(bytes.size())] ^= static_cast<std::uint8_t>(1 << Below(8));
        break;
      case 1:
        if (!bytes.empty()) bytes[Below(bytes.size())] = static_cast<std::uint8_t>(random_());
        break;
      case 2:
        PutNumber(Below(bytes.size()), bytes);
        break;
      case 3:  // offsets where scan_t has its format, step and counts
        PutNumber(32 + Below(12), bytes);
        break;
      case 4:
        bytes.resize(Below(bytes.size() + 1));
        break;
      default:
        bytes.resize(bytes.size() + Below(2 * kPointBytes + 2),
                     static_cast<std::uint8_t>(random_()));
        break;
    }
  }

 private:
  void PutNumber(std::size_t at, Bytes& bytes) {
    static constexpr std::uint32_t kNumbers[] = {
        0,          1,          3,          20,         60,          0x7f,
        0x80,       0xff,       0x7fff,     0x8000,     0x0ccccccd,  0x20000000,
        0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff, 100'000'000, 2'000'000'000};
    const std::uint32_t number = kNumbers[Below(std::size(kNumbers))];
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
    }
  }

  std::mt19937 random_;
};

std::vector<Bytes> Seeds() {
  std::vector<Bytes> seeds;
  const Timestamp stamp{1'700'000'000'123'456'000};
  seeds.push_back(EncodeImu({stamp, Vector3(0.1, 0.2, 0.3), Vector3(0.0, 0.1, 9.8)}, 17));
  for (const std::size_t num_points : {0u, 1u, 3u, 40u}) {
    ScanChunk chunk{stamp, 5, 1, 4, 0, {}};
    chunk.points.assign(num_points, {1.0F, 2.0F, 3.0F, 400, 50, 6});
    seeds.push_back(EncodeChunk(chunk));
  }
  return seeds;
}

TEST(LcmCodecFuzz, OneMillionMutantsAreDecodedOrRefused) {
  const std::vector<Bytes> seeds = Seeds();
  Mutator mutator(20260101);
  ImuSample sample;
  ScanChunk chunk;
  std::int32_t seq = 0;
  int num_imu = 0;
  int num_scan = 0;
  for (int i = 0; i < kNumMessageMutants; ++i) {
    Bytes mutant = seeds[mutator.Below(seeds.size())];
    for (std::size_t rounds = 1 + mutator.Below(3); rounds > 0; --rounds) mutator.Mutate(mutant);
    // The block has exactly the message's size, so that a sanitizer sees the first byte behind it.
    const auto block = std::make_unique<std::uint8_t[]>(mutant.size());
    if (!mutant.empty()) std::memcpy(block.get(), mutant.data(), mutant.size());
    const ByteView view(block.get(), mutant.size());

    if (DecodeImu(view, sample, seq) == DecodeStatus::kOk) {
      ++num_imu;
      ASSERT_EQ(view.size(), seeds[0].size());
    }
    if (DecodeChunk(view, chunk) == DecodeStatus::kOk) {
      ++num_scan;
      ASSERT_EQ(view.size(), kScanFixedBytes + chunk.points.size() * kPointBytes);
      // The message was accepted: encoding it again gives the same bytes except the device's own
      // clock.
      Bytes again = EncodeChunk(chunk);
      std::memcpy(again.data() + 16, view.data() + 16, 8);
      ASSERT_EQ(std::memcmp(again.data(), view.data(), view.size()), 0) << "mutant " << i;
    }
  }
  // Both outcomes must be frequent, or the test would test nothing.
  EXPECT_GT(num_imu, kNumMessageMutants / 50);
  EXPECT_GT(num_scan, kNumMessageMutants / 20);
  EXPECT_LT(num_imu + num_scan, kNumMessageMutants / 2);
}

}  // namespace
}  // namespace lio
