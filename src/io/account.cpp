// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/account.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <numeric>

namespace lio {
namespace {

using Json = nlohmann::ordered_json;
using Refusals = std::array<std::int64_t, kNumDecodeStatuses>;

// Holds everything that was counted before the estimator.
struct Entry {
  std::int64_t num_received;
  const Refusals& refusals;
  const TransitCounters& transit;
};

Entry ImuEntry(const Account& account, const InputCounters& input) {
  return {input.num_imu_received, input.num_imu_refused, account.imu};
}

Entry ChunkEntry(const Account& account, const InputCounters& input) {
  return {input.num_chunks_received, input.num_chunks_refused, account.chunks};
}

template <typename Ledger>
std::int64_t Unaccounted(const Entry& entry, const Ledger& ledger) {
  const std::int64_t num_refused =
      std::accumulate(entry.refusals.begin(), entry.refusals.end(), std::int64_t{0});
  return entry.num_received - num_refused - entry.transit.num_dropped - entry.transit.num_given_up -
         entry.transit.num_waiting - ledger.num_received + ledger.Unaccounted();
}

template <typename Ledger, typename Names>
void AddFates(const Ledger& ledger, const Names& names, Json& json) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    json[std::string(names[i])] = ledger.num_settled[i];
  }
}

template <typename Ledger, typename Names>
Json MessageJson(const Entry& entry, const Ledger& ledger, const Names& names) {
  Json json{{"received", entry.num_received}};
  for (int i = 1; i < kNumDecodeStatuses; ++i) {
    json[std::string(Name(static_cast<DecodeStatus>(i)))] =
        entry.refusals[static_cast<std::size_t>(i)];
  }
  json["queue_dropped"] = entry.transit.num_dropped;
  json["given_up"] = entry.transit.num_given_up;
  AddFates(ledger, names, json);
  json["waiting"] = entry.transit.num_waiting + ledger.num_waiting;
  json["unaccounted"] = Unaccounted(entry, ledger);
  return json;
}

}  // namespace

std::string AccountJson(const Account& account, const InputCounters& input) {
  const Ledgers& ledgers = account.ledgers;
  Json scans{{"received", ledgers.scans.num_received}};
  AddFates(ledgers.scans, kScanFateNames, scans);
  scans["waiting"] = ledgers.scans.num_waiting;
  scans["unaccounted"] = ledgers.scans.Unaccounted();
  const Json json{
      {"imu", MessageJson(ImuEntry(account, input), ledgers.samples, kSampleFateNames)},
      {"chunks", MessageJson(ChunkEntry(account, input), ledgers.chunks, kChunkFateNames)},
      {"scans", scans}};
  return json.dump();
}

std::string WhyOpen(const Account& account, const InputCounters& input) {
  const std::int64_t samples = Unaccounted(ImuEntry(account, input), account.ledgers.samples);
  const std::int64_t chunks = Unaccounted(ChunkEntry(account, input), account.ledgers.chunks);
  const std::int64_t scans = account.ledgers.scans.Unaccounted();
  if (samples == 0 && chunks == 0 && scans == 0) return {};
  return fmt::format(
      "the account does not close: {} inertial samples, {} chunks and {} scans have no fate",
      samples, chunks, scans);
}

}  // namespace lio
