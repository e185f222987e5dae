// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/serve.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace lio {
namespace {

ServerOptions OnAnyPort() {
  ServerOptions options;
  options.port = 0;
  return options;
}

TEST(ServeWhile, ExceptionOfTheFeedEndsTheServingAndIsToldInOneLine) {
  const ViewHub hub;
  ViewServer server(OnAnyPort(), hub, nullptr);
  const auto fault = ServeWhile(
      [](const std::stop_token&) { throw std::runtime_error("the log went away"); }, server);
  EXPECT_EQ(fault, "the feed thread failed: the log went away");
}

TEST(ServeWhile, EndOfTheServingStopsTheFeed) {
  const ViewHub hub;
  ViewServer server(OnAnyPort(), hub, nullptr);
  bool was_stopped = false;
  const auto fault = ServeWhile(
      [&](const std::stop_token& stop) {
        server.Stop();
        while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        was_stopped = true;
      },
      server);
  EXPECT_EQ(fault, std::nullopt);
  EXPECT_TRUE(was_stopped);
}

}  // namespace
}  // namespace lio
