// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/ledger.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(Ledger, ClosesWhenEachMessageIsSettledOnceOrWaits) {
  Ledgers ledgers;
  auto& scans = ledgers.scans;
  for (int i = 0; i < 5; ++i) scans.Receive();
  EXPECT_EQ(scans.Unaccounted(), 5);
  scans.Settle(ScanFate::kUsed, 3);
  scans.Settle(ScanFate::kLate);
  scans.num_waiting = 1;
  EXPECT_EQ(scans.Unaccounted(), 0);
  scans.Settle(ScanFate::kLate);
  EXPECT_EQ(scans.Unaccounted(), -1);
}

TEST(Ledger, AFateThatTurnsOutToBeAnotherKeepsItClosed) {
  Ledgers ledgers;
  ledgers.samples.Receive();
  ledgers.samples.Settle(SampleFate::kUsed);
  ledgers.samples.Move(SampleFate::kUsed, SampleFate::kLate);
  EXPECT_EQ(ledgers.samples.Of(SampleFate::kUsed), 0);
  EXPECT_EQ(ledgers.samples.Of(SampleFate::kLate), 1);
  EXPECT_EQ(ledgers.samples.Unaccounted(), 0);
}

TEST(Ledger, WhatWaitsCanBeForgottenOnce) {
  Ledgers ledgers;
  ledgers.chunks.Receive();
  ledgers.chunks.num_waiting = 1;
  ledgers.chunks.ForgetWaiting();
  ledgers.chunks.ForgetWaiting();
  EXPECT_EQ(ledgers.chunks.Of(ChunkFate::kForgotten), 1);
  EXPECT_EQ(ledgers.chunks.Unaccounted(), 0);
}

TEST(Ledger, TheSpanBetweenTwoLooksClosesAsWell) {
  Ledgers begin;
  begin.samples.Receive();
  begin.samples.num_waiting = 1;
  Ledgers end = begin;
  end.samples.Receive();
  end.samples.Settle(SampleFate::kUsed, 2);
  end.samples.num_waiting = 0;
  end -= begin;
  EXPECT_EQ(end.samples.num_received, 1);
  EXPECT_EQ(end.samples.num_waiting, -1);
  EXPECT_EQ(end.samples.Unaccounted(), 0);
}

}  // namespace
}  // namespace lio
