// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/worker_thread.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace lio {
namespace {

std::string FaultText(const std::string& who, const char* what) {
  std::string text = fmt::format("{} failed: {}", who, what);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// The thread works as well, but not as soon, where the system refuses.
void DescribeToSystem(const std::string& name, Urgency urgency) {
  constexpr std::size_t kMaxNameBytes = 15;
  (void)pthread_setname_np(pthread_self(), name.substr(0, kMaxNameBytes).c_str());
  if (urgency == Urgency::kAtOnce) return;
  constexpr pid_t kThisThread = 0;
  const int policy = sched_getscheduler(kThisThread);
  const bool is_realtime = policy == SCHED_FIFO || policy == SCHED_RR;
  if (urgency == Urgency::kSoon && is_realtime) {
    // A service that may set no real-time policy may still lower its priority in it.
    const sched_param lowest{.sched_priority = sched_get_priority_min(policy)};
    (void)sched_setparam(kThisThread, &lowest);
  } else {
    const sched_param none{};
    (void)sched_setscheduler(kThisThread, SCHED_BATCH, &none);
  }
}

}  // namespace

std::optional<std::string> RunCatching(const std::string& who, const std::function<void()>& body) {
  try {
    body();
    return std::nullopt;
  } catch (const std::exception& error) {
    return FaultText(who, error.what());
  } catch (...) {
    return FaultText(who, "an exception of an unknown type");
  }
}

WorkerThread::WorkerThread(std::string name, OnFault on_fault, Urgency urgency)
    : name_(std::move(name)), on_fault_(std::move(on_fault)), urgency_(urgency) {}

WorkerThread::~WorkerThread() {
  Join();
}

void WorkerThread::Start(std::function<void()> body) {
  thread_ = std::thread([this, body = std::move(body)] { Run(body); });
}

void WorkerThread::Run(const std::function<void()>& body) {
  DescribeToSystem(name_, urgency_);
  if (const auto fault = RunCatching("the " + name_ + " thread", body)) on_fault_(*fault);
  ended_.set_value();
}

void WorkerThread::Join() {
  if (thread_.joinable()) thread_.join();
}

bool WorkerThread::EndsWithin(std::chrono::milliseconds timeout) const {
  return !thread_.joinable() || has_ended_.wait_for(timeout) == std::future_status::ready;
}

void FaultLatch::Set(const std::string& fault) {
  const std::lock_guard lock(mutex_);
  if (!first_) first_ = fault;
}

std::optional<std::string> FaultLatch::first() const {
  const std::lock_guard lock(mutex_);
  return first_;
}

}  // namespace lio
