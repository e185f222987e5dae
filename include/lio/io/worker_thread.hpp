// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the threads of the daemon and of the viewer. An exception that leaves a thread's body ends
// that thread and not the process: it is reported in words, so that the run can end in order, with
// its files complete.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace lio {

// It is called with one line, e.g. "the match thread failed: std::bad_alloc". Must not throw.
using OnFault = std::function<void(const std::string& fault)>;

// Runs `body` on the calling thread. Returns nothing when it ended well, otherwise one line that
// says what `who` (e.g. "the match thread") was ended by.
[[nodiscard]] std::optional<std::string> RunCatching(const std::string& who,
                                                     const std::function<void()>& body);

// How soon a thread must run once there is something for it to do.
enum class Urgency {
  kAtOnce,  // as the thread that starts it, at its priority
  // After all threads that are needed at once: waking it interrupts none of them (SCHED_BATCH). In
  // a process with a real-time policy it keeps that policy at the lowest priority, so that no
  // ordinary program stops it while it holds what an urgent thread waits for.
  kSoon,
};

// Makes the calling thread as urgent as that; it stays as it was where the system refuses.
void SetUrgency(Urgency urgency);

class WorkerThread {
 public:
  // The system's tools show the first 15 characters of the name. `on_fault` is called on the thread
  // itself, after the body was left by an exception.
  WorkerThread(std::string name, OnFault on_fault, Urgency urgency = Urgency::kAtOnce);
  ~WorkerThread();  // joins: whoever owns the thread tells its body to end first
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  // It runs once only. Throws std::system_error when the system has no thread left.
  void Start(std::function<void()> body);
  // Waits for the body to end. Does nothing before Start and after an earlier Join.
  void Join();
  // Waits for the body to end, but no longer than `timeout`; false when it is still running. It
  // returns true before Start.
  [[nodiscard]] bool EndsWithin(std::chrono::milliseconds timeout) const;

 private:
  void Run(const std::function<void()>& body);

  std::string name_;
  OnFault on_fault_;
  const Urgency urgency_;
  std::promise<void> ended_;
  std::future<void> has_ended_ = ended_.get_future();
  std::thread thread_;
};

// Keeps the first fault of several threads. Any thread may call any function.
class FaultLatch {
 public:
  void Set(const std::string& fault);
  [[nodiscard]] std::optional<std::string> first() const;

 private:
  mutable std::mutex mutex_;  // guards first_
  std::optional<std::string> first_;
};

}  // namespace lio
