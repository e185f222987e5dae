// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/sender_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

// Sends sample `k` of a sender of 100 Hz whose numbers begin with `first`.
bool Send(SenderWatch& watch, int k, std::int32_t first = 0, double late_s = 0.0) {
  const auto seq =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(k));
  return watch.IsForeign(seq, StampAt(0.01 * k + late_s));
}

TEST(SenderWatch, OneSenderIsNeverForeign) {
  SenderWatch watch;
  for (int k = 0; k < 200; ++k) EXPECT_FALSE(Send(watch, k)) << k;
}

TEST(SenderWatch, HolesRepeatsAndReorderedSamplesAreNoSecondSender) {
  SenderWatch watch;
  for (int k = 0; k < 1000; ++k) {
    if (k % 7 == 0) continue;  // lost
    EXPECT_FALSE(Send(watch, k)) << k;
    if (k % 3 == 0) {
      EXPECT_FALSE(Send(watch, k)) << "repeated " << k;
    }
    if (k % 5 == 0 && k > 5) {
      EXPECT_FALSE(Send(watch, k - 3)) << "late " << k;
    }
  }
}

TEST(SenderWatch, DriverThatDoesNotCountIsNoSecondSender) {
  SenderWatch watch;
  for (int k = 0; k < 200; ++k) EXPECT_FALSE(watch.IsForeign(0, StampAt(0.01 * k))) << k;
}

TEST(SenderWatch, DriverThatStartsAgainIsNoSecondSender) {
  SenderWatch watch;
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(Send(watch, k, 5000)) << k;
  for (int k = 200; k < 400; ++k) EXPECT_FALSE(Send(watch, k, -200)) << k;
}

TEST(SenderWatch, NumbersMayWrap) {
  SenderWatch watch;
  const std::int32_t near_the_end = std::numeric_limits<std::int32_t>::max() - 50;
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(Send(watch, k, near_the_end)) << k;
}

TEST(SenderWatch, SecondSenderIsForeignFromItsFourthSample) {
  for (const std::int32_t offset : {0, 3, -3, 100'000}) {
    SenderWatch watch;
    for (int k = 0; k < 50; ++k) EXPECT_FALSE(Send(watch, k));
    for (int k = 50; k < 150; ++k) {
      EXPECT_FALSE(Send(watch, k)) << "the first one is kept";
      EXPECT_EQ(Send(watch, k, offset, 0.002), k >= 53) << k << ", offset " << offset;
    }
    EXPECT_EQ(watch.kept_seq(), 149u);
  }
}

TEST(SenderWatch, FasterSecondSenderDoesNotDisplaceTheFirst) {
  SenderWatch watch;
  int num_foreign = 0;
  for (int k = 0; k < 400; ++k) {  // 400 Hz beside 100 Hz
    if (k % 4 == 0) {
      EXPECT_FALSE(Send(watch, k / 4)) << k;
    }
    num_foreign += watch.IsForeign(70'000 + k, StampAt(0.0025 * k + 0.001)) ? 1 : 0;
  }
  EXPECT_GT(num_foreign, 380);
}

TEST(SenderWatch, SecondSenderIsTakenOnceTheFirstIsGone) {
  SenderWatch watch;
  for (int k = 0; k < 100; ++k) {
    (void)Send(watch, k);
    (void)Send(watch, k, 9000, 0.002);
  }
  EXPECT_TRUE(Send(watch, 100, 9000, 0.002));
  for (int k = 101; k < 200; ++k) (void)Send(watch, k, 9000, 0.002);
  EXPECT_FALSE(Send(watch, 200, 9000, 0.002));
}

}  // namespace
}  // namespace lio
