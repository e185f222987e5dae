// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/live_feed.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "view/view_fixture.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

std::uint32_t PoseNumber(const ViewHub& hub) {
  std::uint32_t number = 0;
  hub.Read([&](const ViewState& view) { number = view.pose().number; });
  return number;
}

TEST(LiveFeed, HearsTheDaemonsMessagesUntilItIsStopped) {
  std::unique_ptr<Bus> bus = OpenMemoryBus();
  Bus& sender = *bus;
  ViewHub hub;
  LiveFeed feed(std::move(bus), "CAR_", hub);
  ASSERT_TRUE(sender.Publish("CAR_ODOM", EncodeOdometry(test::NavAt(1))));
  ASSERT_TRUE(sender.Publish("LIO_ODOM", EncodeOdometry(test::NavAt(2))));
  ASSERT_TRUE(sender.Publish("CAR_ODOM", Bytes(834, 0)));
  std::jthread worker([&](const std::stop_token& stop) { feed.Run(stop); });
  for (int i = 0; i < 500 && PoseNumber(hub) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  worker.request_stop();
  worker.join();
  EXPECT_EQ(PoseNumber(hub), 1U);
  hub.Read([](const ViewState& view) { EXPECT_LE(view.num_refused(), 1); });
}

TEST(LiveFeed, AUrlThatCannotBeOpenedIsTold) {
  ViewHub hub;
  EXPECT_THROW(LiveFeed("nonsense://", "LIO_", hub), TransportError);
}

TEST(LiveFeed, AFileThatHasEndedStaysAsItIs) {
  ViewHub hub;
  EXPECT_THROW(LiveFeed("file:///does/not/exist.lcm", "LIO_", hub), TransportError);
}

}  // namespace
}  // namespace lio
