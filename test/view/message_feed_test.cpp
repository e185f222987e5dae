// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/message_feed.hpp"

#include <gtest/gtest.h>

#include "view/view_fixture.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

using test::CloudOf;
using test::NavAt;
using test::StatusOfRun;
using test::UtimeAt;

TEST(MessageFeed, EveryChannelGoesToItsPartOfTheState) {
  ViewHub hub;
  MessageFeed feed(Channels("LIO_"), hub);
  FilterReport report;
  report.nav = NavAt(1);
  feed.Take("LIO_ODOM", EncodeOdometry(NavAt(1)), UtimeAt(1));
  feed.Take("LIO_ODOM_IMU", EncodeOdometry(NavAt(2, OdometrySource::kImuPropagated)), UtimeAt(2));
  feed.Take("LIO_STATE", EncodeFilterState(report), UtimeAt(1));
  feed.Take("LIO_REG", EncodeRegistration({}), UtimeAt(1));
  feed.Take("LIO_STATUS", EncodeStatus(StatusOfRun(1), "0.1.0"), UtimeAt(1));
  feed.Take("LIO_CLOUD", EncodeChunk(CloudOf(1, 10)), UtimeAt(1));
  feed.Take("LIO_CLOUD_FULL", EncodeChunk(CloudOf(2, 20)), UtimeAt(1));
  hub.Read([](const ViewState& view) {
    EXPECT_EQ(view.pose().number, 2U);
    EXPECT_EQ(view.path().rows().size(), 1U);
    EXPECT_EQ(view.states().rows().size(), 1U);
    EXPECT_EQ(view.registration().number, 1U);
    EXPECT_EQ(view.status().number, 1U);
    EXPECT_EQ(view.map().points_map().size(), 20U);
    EXPECT_EQ(view.num_refused(), 0);
  });
}

TEST(MessageFeed, GarbageIsCountedAndChangesNothing) {
  ViewHub hub;
  MessageFeed feed(Channels("LIO_"), hub);
  for (const std::string& name : feed.Names()) {
    feed.Take(name, Bytes{}, 0);
    feed.Take(name, Bytes(1000, 0xff), 0);
    feed.Take(name, EncodeImu({}, 1), 0);
  }
  feed.Take("ELSE", Bytes{}, 0);
  hub.Read([&](const ViewState& view) {
    EXPECT_EQ(view.num_refused(), 3 * static_cast<std::int64_t>(feed.Names().size()));
    EXPECT_EQ(view.pose().number, 0U);
    EXPECT_TRUE(view.map().points_map().empty());
  });
}

TEST(MessageFeed, ChannelsHaveThePrefix) {
  ViewHub hub;
  const MessageFeed feed(Channels("CAR_"), hub);
  EXPECT_TRUE(feed.Takes("CAR_ODOM"));
  EXPECT_FALSE(feed.Takes("LIO_ODOM"));
  EXPECT_FALSE(feed.Takes("CAR_SCAN"));
}

}  // namespace
}  // namespace lio
