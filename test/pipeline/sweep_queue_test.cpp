// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/sweep_queue.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace lio {
namespace {

void Fill(SweepQueue& queue, int num_sweeps) {
  for (int i = 0; i < num_sweeps; ++i) {
    auto sweep = std::make_shared<Sweep>();
    sweep->scan_seq = i;
    queue.sweeps().push_back(sweep);
  }
}

TEST(SweepQueue, OneSweepIsOutAtATime) {
  SweepQueue queue(5);
  EXPECT_FALSE(queue.StartNext(0));
  Fill(queue, 2);
  const SweepPtr first = queue.StartNext(0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->scan_seq, 0);
  EXPECT_FALSE(queue.StartNext(0));
  EXPECT_TRUE(queue.Finish(first, 0));
  queue.sweeps().pop_front();
  const SweepPtr second = queue.StartNext(0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->scan_seq, 1);
}

TEST(SweepQueue, SweepsThatAreLookedBackOnAreNotMatchedAnew) {
  SweepQueue queue(5);
  Fill(queue, 3);
  const SweepPtr third = queue.StartNext(2);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->scan_seq, 2);
  EXPECT_TRUE(queue.Finish(third, 2));
  EXPECT_FALSE(queue.StartNext(3));
}

TEST(SweepQueue, OutcomeOfASweepThatWasGivenUpIsToldAsSuch) {
  SweepQueue queue(5);
  Fill(queue, 1);
  const SweepPtr sweep = queue.StartNext(0);
  queue.sweeps().clear();
  EXPECT_FALSE(queue.Finish(sweep, 0));
  Fill(queue, 1);
  EXPECT_FALSE(queue.Finish(sweep, 0));  // nothing was out
  (void)queue.StartNext(0);
  EXPECT_FALSE(queue.Finish(sweep, 0));  // another one was
  EXPECT_TRUE(queue.StartNext(0));
}

TEST(SweepQueue, TheSweepThatIsOutIsUnmatchedEvenIfItWasGivenUp) {
  SweepQueue queue(5);
  EXPECT_EQ(queue.NumUnmatched(0), 0U);
  Fill(queue, 3);
  EXPECT_EQ(queue.NumUnmatched(0), 3U);
  EXPECT_EQ(queue.NumUnmatched(2), 1U);
  const SweepPtr sweep = queue.StartNext(0);
  EXPECT_EQ(queue.NumUnmatched(0), 3U);
  queue.sweeps().clear();
  EXPECT_EQ(queue.NumUnmatched(0), 1U);
  (void)queue.Finish(sweep, 0);
  EXPECT_EQ(queue.NumUnmatched(0), 0U);
}

TEST(SweepQueue, OldestThatWaitAreShed) {
  SweepQueue queue(2);
  Fill(queue, 5);
  (void)queue.StartNext(0);
  EXPECT_EQ(queue.Shed(0, false), 2U);
  ASSERT_EQ(queue.sweeps().size(), 3U);
  EXPECT_EQ(queue.sweeps()[0]->scan_seq, 0);  // is out
  EXPECT_EQ(queue.sweeps()[1]->scan_seq, 3);
  EXPECT_EQ(queue.sweeps()[2]->scan_seq, 4);
  EXPECT_EQ(queue.Shed(0, false), 0U);
}

TEST(SweepQueue, SweepsThatAreLookedBackOnDoNotWait) {
  SweepQueue queue(2);
  Fill(queue, 5);
  EXPECT_EQ(queue.Shed(2, false), 1U);
  EXPECT_EQ(queue.sweeps()[1]->scan_seq, 1);
  EXPECT_EQ(queue.sweeps()[2]->scan_seq, 3);
}

TEST(SweepQueue, AModeThatLooksBackMayMatchEightySweepsAnew) {
  SweepQueue queue(2);
  Fill(queue, 83);
  EXPECT_EQ(queue.Shed(0, true), 1U);
}

TEST(SweepQueue, SweepsThatCameTogetherAreNoOverloadWhileTheyWait) {
  SweepQueue queue(2);
  Fill(queue, 6);
  queue.AddSetFree(1);  // as ever
  queue.AddSetFree(4);
  EXPECT_EQ(queue.Shed(0, false), 0U);
  queue.sweeps().clear();
  EXPECT_EQ(queue.Shed(0, false), 0U);
  Fill(queue, 6);
  EXPECT_EQ(queue.Shed(0, false), 4U);
}

}  // namespace
}  // namespace lio
