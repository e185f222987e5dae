// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the bus over liblcm, through its C interface and raw subscriptions. Typed subscriptions
// decode before the bytes can be checked, and one bad count then ends the process.
#include <lcm/lcm.h>
#include <poll.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

#include "lio/io/bus.hpp"
#include "queue_capacity.hpp"
#include "stderr_capture.hpp"

namespace lio {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667";
constexpr std::size_t kMaxLcmChannelBytes = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH

// liblcm takes subscriptions as regular expressions.
std::string Literally(const std::string& channel) {
  std::string expression;
  for (const char c : channel) {
    if (std::strchr("\\^$.|?*+()[]{}", c) != nullptr) expression += '\\';
    expression += c;
  }
  return expression;
}

std::string WhatToDo(const std::string& url) {
  if (url.starts_with("tcpq:")) return "start its server: java -cp lcm.jar lcm.lcm.TCPService PORT";
  if (url.starts_with("file:")) return "name an existing log";
  if (!url.starts_with("udpm:")) return "give a URL of udpm://, tcpq:// or file://";
  return "if this machine has no multicast route: sudo ip link set lo up && "
         "sudo ip route add 224.0.0.0/4 dev lo";
}

lcm_t* Open(const std::string& url) {
  StderrCapture capture;
  lcm_t* lcm = lcm_create(url.c_str());
  // Asking for the descriptor makes udpm open its receive socket now and not with the first
  // subscription, so that FindUdpSocket finds it. It also shows whether tcpq has a connection.
  const bool is_usable = lcm != nullptr && lcm_get_fileno(lcm) >= 0;
  const std::string words = capture.Finish();
  if (!is_usable) {
    if (lcm != nullptr) lcm_destroy(lcm);
    const std::string reason = capture.fault().empty()
                                   ? words.substr(0, words.find('\n'))
                                   : "its reason went to stderr, " + capture.fault();
    throw TransportError("LCM cannot open " + url + " (" + reason + "); " + WhatToDo(url));
  }
  std::fputs(words.c_str(), stderr);
  return lcm;
}

class LcmBus final : public Bus {
 public:
  explicit LcmBus(const std::string& url) : lcm_(Open(url)) {}
  ~LcmBus() override { lcm_destroy(lcm_); }
  LcmBus(const LcmBus&) = delete;
  LcmBus& operator=(const LcmBus&) = delete;

  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    if (channel.empty() || channel.size() > kMaxLcmChannelBytes) {
      throw std::invalid_argument("channel name '" + channel + "' must have 1 to 63 characters");
    }
    subscribers_.push_back(
        std::make_unique<Subscriber>(*this, std::move(handler), QueueCapacity(queue_capacity)));
    lcm_subscription_t* subscription = lcm_subscribe(lcm_, Literally(channel).c_str(),
                                                     &LcmBus::Deliver, subscribers_.back().get());
    if (subscription == nullptr) throw TransportError("LCM refuses the channel name " + channel);
    lcm_subscription_set_queue_capacity(subscription, queue_capacity);
    subscribers_.back()->subscription = subscription;
  }

  // Calls poll itself, because lcm_handle_timeout aborts the process when a tcpq connection is down
  // and when more than 1024 files are open.
  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    pollfd waiting{.fd = lcm_get_fileno(lcm_), .events = POLLIN, .revents = 0};
    if (waiting.fd < 0) {
      std::this_thread::sleep_for(timeout);
      return ReceiveResult::kClosed;
    }
    const int num_ready = ::poll(&waiting, 1, static_cast<int>(timeout.count()));
    if (num_ready <= 0) return ReceiveResult::kTimeout;
    return lcm_handle(lcm_) == 0 ? ReceiveResult::kMessage : ReceiveResult::kClosed;
  }

  bool Publish(const std::string& channel, ByteView data) override {
    const std::lock_guard lock(publish_mutex_);
    return lcm_publish(lcm_, channel.c_str(), data.data(), static_cast<unsigned>(data.size())) == 0;
  }

  std::int64_t num_oversized() const override { return num_oversized_; }
  std::int64_t num_handler_faults() const override { return num_handler_faults_; }

 private:
  struct Subscriber {
    Subscriber(LcmBus& owner, Handler function, QueueCapacity messages)
        : bus(owner), handler(std::move(function)), capacity(messages) {}
    LcmBus& bus;
    Handler handler;
    QueueCapacity capacity;
    lcm_subscription_t* subscription = nullptr;
  };

  // liblcm's C frames are below on the stack: no exception may pass through them. The size is
  // checked first, because liblcm announces a datagram whose channel name has no end with almost
  // 2^32 bytes.
  static void Deliver(const lcm_recv_buf_t* buffer, const char*, void* user) noexcept {
    auto& subscriber = *static_cast<Subscriber*>(user);
    if (buffer->data_size > kMaxMessageBytes) {
      ++subscriber.bus.num_oversized_;
      return;
    }
    if (subscriber.capacity.Take(buffer->data_size)) {  // this changes a number alone
      lcm_subscription_set_queue_capacity(subscriber.subscription, subscriber.capacity.now());
    }
    try {
      subscriber.handler({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size},
                         buffer->recv_utime);
    } catch (...) {
      ++subscriber.bus.num_handler_faults_;
    }
  }

  lcm_t* lcm_;
  std::mutex publish_mutex_;  // liblcm's tcpq provider does not lock
  std::vector<std::unique_ptr<Subscriber>> subscribers_;
  std::atomic<std::int64_t> num_oversized_ = 0;
  std::atomic<std::int64_t> num_handler_faults_ = 0;
};

}  // namespace

std::string EffectiveUrl(const std::string& url) {
  if (!url.empty()) return url;
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  return from_environment != nullptr && *from_environment != '\0' ? from_environment : kDefaultUrl;
}

std::unique_ptr<Bus> OpenLcmBus(const std::string& url) {
  return std::make_unique<LcmBus>(EffectiveUrl(url));
}

int UdpPort(const std::string& url) {
  const std::string effective = EffectiveUrl(url);
  if (!effective.starts_with("udpm://")) return 0;
  constexpr int kDefaultPort = 7667;
  const std::string address = effective.substr(7, effective.find('?') - 7);
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon + 1 == address.size()) return kDefaultPort;
  return std::atoi(address.c_str() + colon + 1);
}

}  // namespace lio
