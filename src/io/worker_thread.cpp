// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/worker_thread.hpp"

#include <fmt/format.h>

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

WorkerThread::WorkerThread(std::string name, OnFault on_fault)
    : name_(std::move(name)), on_fault_(std::move(on_fault)) {}

WorkerThread::~WorkerThread() {
  Join();
}

void WorkerThread::Start(std::function<void()> body) {
  thread_ = std::thread([this, body = std::move(body)] { Run(body); });
}

void WorkerThread::Run(const std::function<void()>& body) {
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
