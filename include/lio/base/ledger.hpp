// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A ledger follows messages of one kind to their fates: each that is received is settled once, or
// waits still. So received = settled + waiting holds at every instant, or a message was forgotten.
//
// Counters beside it count events; one message may be in several of them, or in none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

namespace lio {

enum class SampleFate {
  kUsed,
  kNonfinite,
  kOutOfRange,
  kDuplicate,
  kLate,
  kForeign,
  kUnwanted,
  kForgotten
};
inline constexpr std::array<std::string_view, 8> kSampleFateNames{
    "used", "nonfinite", "out_of_range", "duplicate", "late", "foreign", "unwanted", "forgotten"};

// A used chunk is part of a scan.
enum class ChunkFate { kUsed, kBad, kDuplicate, kLate, kForeign, kUnwanted, kForgotten };
inline constexpr std::array<std::string_view, 7> kChunkFateNames{
    "used", "bad", "duplicate", "late", "foreign", "unwanted", "forgotten"};

// A used scan was fused, or a map began with it. One before the start has no row.
enum class ScanFate {
  kUsed,
  kRejected,
  kBeforeStart,
  kEmpty,
  kLate,
  kWithoutImu,
  kDropped,
  kUnwanted,
  kForgotten
};
inline constexpr std::array<std::string_view, 9> kScanFateNames{
    "used",        "rejected", "before_start", "empty",    "late",
    "without_imu", "dropped",  "unwanted",     "forgotten"};

template <typename Fate, std::size_t kNum>
struct Ledger {
  std::int64_t num_received = 0;
  std::int64_t num_waiting = 0;  // as of a look at what waits
  std::array<std::int64_t, kNum> num_settled{};

  void Receive() { ++num_received; }
  void Settle(Fate fate, std::size_t num = 1) {
    num_settled[static_cast<std::size_t>(fate)] += static_cast<std::int64_t>(num);
  }
  // A fate turned out to be another.
  void Move(Fate from, Fate to, std::int64_t num = 1) {
    num_settled[static_cast<std::size_t>(from)] -= num;
    num_settled[static_cast<std::size_t>(to)] += num;
  }
  [[nodiscard]] std::int64_t Of(Fate fate) const {
    return num_settled[static_cast<std::size_t>(fate)];
  }
  // Returns zero when the ledger closes.
  [[nodiscard]] std::int64_t Unaccounted() const {
    return std::accumulate(num_settled.begin(), num_settled.end(), num_received - num_waiting,
                           [](std::int64_t rest, std::int64_t num) { return rest - num; });
  }
  // All that waits is given up, as at a reset.
  void ForgetWaiting() {
    Settle(Fate::kForgotten, static_cast<std::size_t>(std::exchange(num_waiting, 0)));
  }

  Ledger& operator-=(const Ledger& begin) {
    num_received -= begin.num_received;
    num_waiting -= begin.num_waiting;
    for (std::size_t i = 0; i < kNum; ++i) num_settled[i] -= begin.num_settled[i];
    return *this;
  }
};

struct Ledgers {
  Ledger<SampleFate, kSampleFateNames.size()> samples;
  Ledger<ChunkFate, kChunkFateNames.size()> chunks;
  Ledger<ScanFate, kScanFateNames.size()> scans;

  Ledgers& operator-=(const Ledgers& begin) {
    samples -= begin.samples;
    chunks -= begin.chunks;
    scans -= begin.scans;
    return *this;
  }
};

}  // namespace lio
