// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/worker_thread.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace lio {
namespace {

using std::chrono::milliseconds;

TEST(RunCatching, ABodyThatEndsWellGivesNothing) {
  bool has_run = false;
  EXPECT_EQ(RunCatching("the test", [&] { has_run = true; }), std::nullopt);
  EXPECT_TRUE(has_run);
}

TEST(RunCatching, EveryKindOfExceptionBecomesOneLine) {
  EXPECT_EQ(RunCatching("the test", [] { throw std::runtime_error("two\nlines"); }),
            "the test failed: two lines");
  EXPECT_EQ(RunCatching("the test", [] { throw std::bad_alloc(); }),
            "the test failed: std::bad_alloc");
  EXPECT_EQ(RunCatching("the test", [] { throw 7; }),
            "the test failed: an exception of an unknown type");
}

TEST(WorkerThread, ReportsWhatItsBodyThrowsAndEnds) {
  std::string reported;
  std::thread::id reported_on;
  WorkerThread thread("match", [&](const std::string& fault) {
    reported = fault;
    reported_on = std::this_thread::get_id();
  });
  thread.Start([] { throw std::runtime_error("no memory left"); });
  thread.Join();
  EXPECT_EQ(reported, "the match thread failed: no memory left");
  EXPECT_NE(reported_on, std::this_thread::get_id());
  EXPECT_TRUE(thread.EndsWithin(milliseconds(0)));
}

TEST(WorkerThread, ABodyThatEndsWellReportsNothing) {
  WorkerThread thread("match", [](const std::string& fault) { ADD_FAILURE() << fault; });
  thread.Start([] {});
  thread.Join();
  thread.Join();  // again: does nothing
}

TEST(WorkerThread, TellsWhetherItsBodyHasEnded) {
  WorkerThread thread("match", [](const std::string& fault) { ADD_FAILURE() << fault; });
  EXPECT_TRUE(thread.EndsWithin(milliseconds(0))) << "not started";
  std::promise<void> may_end;
  thread.Start([end = may_end.get_future().share()] { end.wait(); });
  EXPECT_FALSE(thread.EndsWithin(milliseconds(1)));
  may_end.set_value();
  EXPECT_TRUE(thread.EndsWithin(std::chrono::minutes(1)));
}

TEST(FaultLatch, KeepsTheFirst) {
  FaultLatch faults;
  EXPECT_EQ(faults.first(), std::nullopt);
  faults.Set("one");
  faults.Set("two");
  EXPECT_EQ(faults.first(), "one");
}

}  // namespace
}  // namespace lio
