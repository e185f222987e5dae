// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numeric>

namespace lio {
namespace {

using Json = nlohmann::ordered_json;
using Refusals = std::array<std::int64_t, kNumDecodeStatuses>;

constexpr std::string_view kReceived = "received";
constexpr std::string_view kWaiting = "waiting";

template <typename Ledger, typename Names>
void AddFates(const Ledger& ledger, const Names& names, AccountPage& page) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    page.entries.push_back({names[i], ledger.num_settled[i]});
  }
}

// Adds everything that was counted before the estimator.
void AddTransit(const Refusals& refusals, const TransitCounters& transit, AccountPage& page) {
  for (int i = 1; i < kNumDecodeStatuses; ++i) {
    page.entries.push_back(
        {Name(static_cast<DecodeStatus>(i)), refusals[static_cast<std::size_t>(i)]});
  }
  page.entries.push_back({"queue_dropped", transit.num_dropped});
  page.entries.push_back({"given_up", transit.num_given_up});
}

struct MessageCounts {
  std::int64_t num_received;
  const Refusals& refusals;
  const TransitCounters& transit;
};

template <typename Ledger, typename Names>
AccountPage MessagePage(std::string_view name, const MessageCounts& counts, const Ledger& ledger,
                        const Names& names) {
  AccountPage page{name, {{kReceived, counts.num_received}}};
  AddTransit(counts.refusals, counts.transit, page);
  AddFates(ledger, names, page);
  page.entries.push_back({kWaiting, counts.transit.num_waiting + ledger.num_waiting});
  return page;
}

AccountPage ScanPage(const Account& account) {
  const auto& ledger = account.ledgers.scans;
  AccountPage page{"scans", {{kReceived, ledger.num_received}}};
  AddFates(ledger, kScanFateNames, page);
  page.entries.push_back({kWaiting, ledger.num_waiting});
  return page;
}

}  // namespace

std::int64_t AccountPage::Unaccounted() const {
  return std::accumulate(
      entries.begin() + 1, entries.end(), num_received(),
      [](std::int64_t rest, const AccountEntry& entry) { return rest - entry.count; });
}

std::vector<AccountPage> AccountPages(const Account& account, const InputCounters& input) {
  const Ledgers& ledgers = account.ledgers;
  return {
      MessagePage("imu", {input.num_imu_received, input.num_imu_refused, account.imu},
                  ledgers.samples, kSampleFateNames),
      MessagePage("chunks", {input.num_chunks_received, input.num_chunks_refused, account.chunks},
                  ledgers.chunks, kChunkFateNames),
      ScanPage(account)};
}

std::string AccountJson(const Account& account, const InputCounters& input) {
  Json json;
  for (const AccountPage& page : AccountPages(account, input)) {
    Json& fates = json[std::string(page.name)];
    for (const AccountEntry& entry : page.entries) fates[std::string(entry.name)] = entry.count;
    fates["unaccounted"] = page.Unaccounted();
  }
  return json.dump();
}

std::string WhyOpen(const Account& account, const InputCounters& input) {
  const std::vector<AccountPage> pages = AccountPages(account, input);
  const auto is_closed = [](const AccountPage& page) { return page.Unaccounted() == 0; };
  if (std::all_of(pages.begin(), pages.end(), is_closed)) return {};
  return fmt::format(
      "the account does not close: {} inertial samples, {} chunks and {} scans have no fate",
      pages[0].Unaccounted(), pages[1].Unaccounted(), pages[2].Unaccounted());
}

}  // namespace lio
