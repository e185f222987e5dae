// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/output_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;
using testing::DoubleNear;
using testing::Pointwise;
using testing::SizeIs;

std::vector<std::string> TextsOf(const std::vector<Output>& outputs) {
  std::vector<std::string> texts;
  for (const Output& output : outputs) texts.push_back(std::get<Notice>(output).text);
  return texts;
}

TEST(OutputQueue, GivesOutputsInTheOrderInWhichTheyCame) {
  OutputQueue queue;
  queue.Notify(StampAt(2.0), Notice::Severity::kWarning, "first");
  queue.Add(NavOutput{});
  queue.Notify(StampAt(1.0), Notice::Severity::kInfo, "stamped earlier");
  const std::vector<Output> outputs = queue.Take();
  ASSERT_EQ(outputs.size(), 3U);
  EXPECT_EQ(std::get<Notice>(outputs[0]).text, "first");
  EXPECT_TRUE(std::holds_alternative<NavOutput>(outputs[1]));
  EXPECT_EQ(std::get<Notice>(outputs[2]).text, "stamped earlier");
}

TEST(OutputQueue, ANoticeHasItsStampAndSeverity) {
  OutputQueue queue;
  queue.Notify(StampAt(2.0), Notice::Severity::kError, "contradiction");
  const auto notice = std::get<Notice>(queue.Take().at(0));
  EXPECT_EQ(notice.stamp, StampAt(2.0));
  EXPECT_EQ(notice.severity, Notice::Severity::kError);
}

TEST(OutputQueue, GivesEachOutputOnce) {
  OutputQueue queue;
  queue.Notify(StampAt(1.0), Notice::Severity::kInfo, "a");
  EXPECT_EQ(queue.Take().size(), 1U);
  EXPECT_TRUE(queue.Take().empty());
  queue.Notify(StampAt(1.0), Notice::Severity::kInfo, "b");
  EXPECT_EQ(TextsOf(queue.Take()), std::vector<std::string>{"b"});
}

// Asks ten times a second and returns when it was told, s.
std::vector<double> ToldAt(OutputQueue& queue, int begin_ds, int end_ds) {
  std::vector<double> told_s;
  for (int at_ds = begin_ds; at_ds < end_ds; ++at_ds) {
    queue.NotifyWaiting(StampAt(0.1 * at_ds), "waiting");
    if (!queue.Take().empty()) told_s.push_back(0.1 * at_ds);
  }
  return told_s;
}

TEST(OutputQueue, WaitingIsToldLessOftenTheLongerItLasts) {
  OutputQueue queue;
  EXPECT_THAT(ToldAt(queue, 0, 1000),
              Pointwise(DoubleNear(0.1), {0.0, 1.0, 3.0, 7.0, 15.0, 31.0, 63.0, 95.0}));
}

TEST(OutputQueue, AnotherWaitIsToldAtOnce) {
  OutputQueue queue;
  EXPECT_THAT(ToldAt(queue, 0, 100), SizeIs(4));
  EXPECT_THAT(ToldAt(queue, 120, 140), Pointwise(DoubleNear(0.1), {12.0, 13.0}));
}

TEST(OutputQueue, WaitingIsToldAfterTheClockWasSetBack) {
  OutputQueue queue;
  queue.NotifyWaiting(StampAt(3600.0), "before");
  queue.NotifyWaiting(StampAt(0.0), "after");
  queue.NotifyWaiting(StampAt(0.5), "too soon");
  EXPECT_EQ(TextsOf(queue.Take()), (std::vector<std::string>{"before", "after"}));
}

TEST(OutputQueue, WaitingIsToldNoMoreOftenWhereOutputsAreTaken) {
  OutputQueue queue;
  queue.NotifyWaiting(StampAt(0.0), "at once");
  (void)queue.Take();
  queue.NotifyWaiting(StampAt(0.1), "too soon");
  EXPECT_TRUE(queue.Take().empty());
}

TEST(OutputQueue, OtherNoticesAreNotHeldBack) {
  OutputQueue queue;
  queue.NotifyWaiting(StampAt(0.0), "waiting");
  queue.Notify(StampAt(0.1), Notice::Severity::kInfo, "one");
  queue.Notify(StampAt(0.1), Notice::Severity::kInfo, "two");
  EXPECT_EQ(queue.Take().size(), 3U);
}

}  // namespace
}  // namespace lio
