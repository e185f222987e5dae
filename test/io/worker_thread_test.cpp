// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/worker_thread.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

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

// How the system runs a thread.
struct Scheduling {
  int policy = -1;
  int priority = -1;
  std::string name;
};

Scheduling SchedulingHere() {
  Scheduling here;
  sched_param param{};
  char name[16];
  here.policy = sched_getscheduler(0);  // 0 is this thread; pthread's own call may be out of date
  if (sched_getparam(0, &param) == 0) here.priority = param.sched_priority;
  if (pthread_getname_np(pthread_self(), name, sizeof(name)) == 0) here.name = name;
  return here;
}

Scheduling SchedulingOf(Urgency urgency) {
  Scheduling seen;
  WorkerThread thread(
      "a name of many letters", [](const std::string& fault) { ADD_FAILURE() << fault; }, urgency);
  thread.Start([&] { seen = SchedulingHere(); });
  thread.Join();
  return seen;
}

// Runs `body` in a thread with that policy; returns false where the system refuses it.
bool RunWithPolicy(int policy, int priority, const std::function<void()>& body) {
  bool is_set = false;
  std::thread([&] {
    const sched_param wanted{.sched_priority = priority};
    is_set = sched_setscheduler(0, policy, &wanted) == 0;
    if (is_set) body();
  }).join();
  return is_set;
}

TEST(WorkerThread, IsNamedAfterItsWork) {
  EXPECT_EQ(SchedulingOf(Urgency::kAtOnce).name, "a name of many ");
}

TEST(WorkerThread, WhatIsNeededSoonInterruptsNothing) {
  if (SchedulingHere().policy != SCHED_OTHER || !RunWithPolicy(SCHED_BATCH, 0, [] {})) {
    GTEST_SKIP() << "the system does not let a thread choose SCHED_BATCH here";
  }
  EXPECT_EQ(SchedulingOf(Urgency::kAtOnce).policy, SCHED_OTHER);
  EXPECT_EQ(SchedulingOf(Urgency::kSoon).policy, SCHED_BATCH);
}

TEST(WorkerThread, WhatIsNeededSoonHasTheLowestRealTimePriority) {
  Scheduling at_once;
  Scheduling soon;
  const bool may_be_realtime = RunWithPolicy(SCHED_FIFO, 2, [&] {
    at_once = SchedulingOf(Urgency::kAtOnce);
    soon = SchedulingOf(Urgency::kSoon);
  });
  if (!may_be_realtime) GTEST_SKIP() << "the system allows no real-time policy here";
  EXPECT_EQ(at_once.policy, SCHED_FIFO);
  EXPECT_EQ(at_once.priority, 2);
  EXPECT_EQ(soon.policy, SCHED_FIFO);
  EXPECT_EQ(soon.priority, 1);
}

TEST(WorkerThread, WhatOthersPutBehindAllStaysThere) {
  Scheduling soon;
  if (!RunWithPolicy(SCHED_IDLE, 0, [&] { soon = SchedulingOf(Urgency::kSoon); })) {
    GTEST_SKIP() << "the system does not let a thread choose SCHED_IDLE here";
  }
  EXPECT_EQ(soon.policy, SCHED_IDLE);
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
