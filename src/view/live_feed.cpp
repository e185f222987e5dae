// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/live_feed.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "lio/io/socket_buffer.hpp"
#include "view/message_feed.hpp"

namespace lio {
namespace {

using std::chrono::milliseconds;

constexpr int kQueueCapacity = 1024;       // clouds in chunks: forty sweeps
constexpr milliseconds kPollInterval(50);  // after which a wish to stop is noticed
constexpr milliseconds kReopenInterval(1000);

// A full cloud comes in a burst, which the kernel's usual buffer does not hold. Without a larger
// one the viewer lacks points, and nothing else.
std::unique_ptr<Bus> OpenWithBuffer(const std::string& url) {
  std::unique_ptr<Bus> bus = OpenLcmBus(url);
  const int port = UdpPort(url);
  const auto socket = port == 0 ? std::nullopt : FindUdpSocket(port);
  if (socket) (void)RaiseReceiveBuffer(*socket, kWantedReceiveBytes);
  return bus;
}

}  // namespace

LiveFeed::LiveFeed(std::string url, std::string channel_prefix, ViewHub& hub)
    : LiveFeed(OpenWithBuffer(url), std::move(channel_prefix), hub) {
  url_ = std::move(url);
}

LiveFeed::LiveFeed(std::unique_ptr<Bus> bus, std::string channel_prefix, ViewHub& hub)
    : channel_prefix_(std::move(channel_prefix)), hub_(hub), bus_(std::move(bus)) {
  Subscribe();
}

void LiveFeed::Subscribe() {
  const auto feed = std::make_shared<MessageFeed>(Channels(channel_prefix_), hub_);
  for (const std::string& name : feed->Names()) {
    bus_->Subscribe(name, kQueueCapacity, [feed, name](ByteView data, std::int64_t recv_utime) {
      feed->Take(name, data, recv_utime);
    });
  }
}

void LiveFeed::OpenAgain() {
  if (!EffectiveUrl(url_).starts_with("tcpq:")) return;
  try {
    bus_ = OpenWithBuffer(url_);
    Subscribe();
  } catch (const TransportError&) {
    // The server is still away; the bus of before says so again after the next wait.
  }
}

void LiveFeed::Run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (bus_->Receive(kPollInterval) != ReceiveResult::kClosed) continue;
    for (milliseconds waited{0}; waited < kReopenInterval && !stop.stop_requested();
         waited += kPollInterval) {
      std::this_thread::sleep_for(kPollInterval);
    }
    OpenAgain();
  }
}

}  // namespace lio
