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

void SetUrgency(Urgency urgency) {
  if (urgency == Urgency::kAtOnce) return;
  constexpr pid_t kThisThread = 0;
  const int policy = sched_getscheduler(kThisThread);
  if (policy == SCHED_FIFO || policy == SCHED_RR) {
    // A service that may set no real-time policy may still lower its priority in it.
    const sched_param lowest{.sched_priority = sched_get_priority_min(policy)};
    (void)sched_setparam(kThisThread, &lowest);
  } else if (policy == SCHED_OTHER) {
    const sched_param none{};
    (void)sched_setscheduler(kThisThread, SCHED_BATCH, &none);
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
  constexpr std::size_t kMaxNameBytes = 15;
  (void)pthread_setname_np(pthread_self(), name_.substr(0, kMaxNameBytes).c_str());
  SetUrgency(urgency_);
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
