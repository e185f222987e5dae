// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the buses without a transport: in memory, and to nowhere.
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "lio/io/bus.hpp"
#include "lio/io/host_clock.hpp"

namespace lio {
namespace {

class MemoryBus final : public Bus {
 public:
  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    const std::lock_guard lock(mutex_);
    subscribers_.push_back({channel, queue_capacity, 0, std::move(handler)});
  }

  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    Message message;
    {
      std::unique_lock lock(mutex_);
      if (!arrived_.wait_for(lock, timeout, [this] { return !messages_.empty(); })) {
        return ReceiveResult::kTimeout;
      }
      message = std::move(messages_.front());
      messages_.pop_front();
      --subscribers_[message.subscriber].num_waiting;
    }
    // The lock is released, so that handlers may publish; `subscribers_` no longer changes, by
    // contract.
    try {
      subscribers_[message.subscriber].handler(message.data, message.recv_utime);
    } catch (...) {
      ++num_handler_faults_;
    }
    return ReceiveResult::kMessage;
  }

  bool Publish(const std::string& channel, ByteView data) override {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < subscribers_.size(); ++i) {
      Subscriber& subscriber = subscribers_[i];
      if (subscriber.channel != channel) continue;
      if (data.size() > kMaxMessageBytes) {
        ++num_oversized_;
      } else if (subscriber.num_waiting < subscriber.queue_capacity) {
        ++subscriber.num_waiting;
        messages_.push_back({i, HostUtime(), Bytes(data.begin(), data.end())});
      }
    }
    arrived_.notify_one();
    return true;
  }

  std::int64_t num_oversized() const override { return num_oversized_; }
  std::int64_t num_handler_faults() const override { return num_handler_faults_; }

 private:
  struct Subscriber {
    std::string channel;
    int queue_capacity = 0;
    int num_waiting = 0;
    Handler handler;
  };
  struct Message {
    std::size_t subscriber = 0;
    std::int64_t recv_utime = 0;
    Bytes data;
  };

  std::mutex mutex_;  // guards messages_ and the subscribers' counts
  std::condition_variable arrived_;
  std::deque<Message> messages_;
  std::vector<Subscriber> subscribers_;
  std::atomic<std::int64_t> num_oversized_ = 0;
  std::atomic<std::int64_t> num_handler_faults_ = 0;
};

class NullBus final : public Bus {
 public:
  void Subscribe(const std::string&, int, Handler) override {}
  ReceiveResult Receive(std::chrono::milliseconds) override { return ReceiveResult::kClosed; }
  bool Publish(const std::string&, ByteView) override { return true; }
  std::int64_t num_oversized() const override { return 0; }
  std::int64_t num_handler_faults() const override { return 0; }
};

}  // namespace

std::unique_ptr<Bus> OpenMemoryBus() {
  return std::make_unique<MemoryBus>();
}

std::unique_ptr<Bus> OpenNullBus() {
  return std::make_unique<NullBus>();
}

}  // namespace lio
