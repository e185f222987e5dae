// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/output_queue.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

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

TEST(OutputQueue, WaitingIsToldOnceASecond) {
  OutputQueue queue;
  queue.NotifyWaiting(StampAt(0.0), "at once");
  queue.NotifyWaiting(StampAt(0.5), "too soon");
  queue.NotifyWaiting(StampAt(0.999), "too soon for another reason");
  queue.NotifyWaiting(StampAt(1.0), "a second later");
  queue.NotifyWaiting(StampAt(1.5), "too soon after that");
  queue.NotifyWaiting(StampAt(2.0), "two seconds later");
  EXPECT_EQ(TextsOf(queue.Take()),
            (std::vector<std::string>{"at once", "a second later", "two seconds later"}));
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
