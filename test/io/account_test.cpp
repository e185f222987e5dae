// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/account.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lio {
namespace {

// Ten samples: one is cut short, two find the queue full, one is given up, one waits, five arrive.
struct Case {
  Case() {
    input.num_imu_received = 10;
    input.num_imu_taken = 9;
    input.num_imu_refused[static_cast<std::size_t>(DecodeStatus::kTruncated)] = 1;
    account.imu = {.num_dropped = 2, .num_given_up = 1, .num_waiting = 1};
    account.ledgers.samples.num_received = 5;
    account.ledgers.samples.num_waiting = 1;
    account.ledgers.samples.Settle(SampleFate::kUsed, 4);
  }
  InputCounters input;
  Account account;
};

TEST(Account, ClosesOverTheDecoderTheQueueAndTheEstimator) {
  const Case with;
  EXPECT_EQ(WhyOpen(with.account, with.input), "");
  const auto json = nlohmann::json::parse(AccountJson(with.account, with.input));
  EXPECT_EQ(json["imu"]["received"], 10);
  EXPECT_EQ(json["imu"]["truncated"], 1);
  EXPECT_EQ(json["imu"]["used"], 4);
  EXPECT_EQ(json["imu"]["waiting"], 2);
  EXPECT_EQ(json["imu"]["unaccounted"], 0);
}

TEST(Account, EveryEntryOfTheFileButTwoAddsUpToWhatWasReceived) {
  const Case with;
  const auto json = nlohmann::json::parse(AccountJson(with.account, with.input));
  for (const char* kind : {"imu", "chunks", "scans"}) {
    std::int64_t sum = 0;
    for (const auto& [name, count] : json[kind].items()) {
      if (name != "received") sum += count.get<std::int64_t>();
    }
    EXPECT_EQ(sum, json[kind]["received"]) << kind;
  }
}

TEST(Account, SaysByHowMuchItIsOpen) {
  Case with;
  ++with.input.num_imu_received;
  with.account.ledgers.scans.Settle(ScanFate::kUsed);
  const std::string why = WhyOpen(with.account, with.input);
  EXPECT_NE(why.find("1 inertial samples, 0 chunks and -1 scans"), std::string::npos) << why;
  const auto json = nlohmann::json::parse(AccountJson(with.account, with.input));
  EXPECT_EQ(json["imu"]["unaccounted"], 1);
  EXPECT_EQ(json["scans"]["unaccounted"], -1);
}

}  // namespace
}  // namespace lio
