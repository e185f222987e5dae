// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/log_player.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lio/io/event_log.hpp"
#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"
#include "view/view_fixture.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

using test::NavAt;
using test::UtimeAt;

// Writes ten seconds of odometry at 10 Hz, among other messages.
class LogPlayerTest : public ::testing::Test {
 protected:
  LogPlayerTest() {
    EventLogWriter writer(log_);
    for (int i = 0; i <= 100; ++i) {
      writer.Write(UtimeAt(0.1 * i), "LIO_IMU", EncodeImu({}, i));
      writer.Write(UtimeAt(0.1 * i), "LIO_ODOM", EncodeOdometry(NavAt(0.1 * i)));
    }
    writer.Close();
  }

  Timeline TimelineNow() {
    Timeline timeline;
    hub_.Read([&](const ViewState& view) { timeline = view.timeline().value; });
    return timeline;
  }
  std::size_t PathRows() {
    std::size_t num = 0;
    hub_.Read([&](const ViewState& view) { num = view.path().rows().size(); });
    return num;
  }

  test::TempDir folder_;
  std::filesystem::path log_ = folder_.path() / "log.lcm";
  ViewHub hub_;
};

TEST_F(LogPlayerTest, ItPlaysAtTheLogsPace) {
  LogPlayer player(log_, "LIO_", hub_);
  EXPECT_EQ(player.num_messages(), 101U);
  EXPECT_NEAR(player.duration_s(), 10.0, 1e-6);
  player.Advance(0.0);
  EXPECT_EQ(PathRows(), 1U);
  for (int i = 0; i < 10; ++i) player.Advance(0.25);
  EXPECT_EQ(PathRows(), 26U);
  EXPECT_NEAR(TimelineNow().t_s, 2.5, 1e-9);
  EXPECT_EQ(TimelineNow().utime, UtimeAt(2.5));
}

TEST_F(LogPlayerTest, APauseHoldsItAndASpeedMultiplies) {
  LogPlayer player(log_, "LIO_", hub_);
  player.Pause();
  player.Advance(1.0);
  EXPECT_EQ(TimelineNow().t_s, 0.0);
  EXPECT_FALSE(TimelineNow().is_playing);
  player.Play();
  player.SetSpeed(4.0);
  player.Advance(1.0);
  EXPECT_NEAR(TimelineNow().t_s, 4.0, 1e-9);
  EXPECT_EQ(TimelineNow().speed, 4.0);
}

TEST_F(LogPlayerTest, SeekingForwardAndBackShowsWhatHadComeByThen) {
  LogPlayer player(log_, "LIO_", hub_);
  player.Pause();
  player.Seek(7.05);
  player.Advance(0.0);
  EXPECT_EQ(PathRows(), 71U);
  player.Seek(2.05);
  player.Advance(0.0);
  EXPECT_EQ(PathRows(), 21U);
  hub_.Read([](const ViewState& view) {
    EXPECT_NEAR(view.pose().value.nav.T_map_imu.translation.x(), 2.0, 1e-9);
  });
  EXPECT_FALSE(TimelineNow().is_seeking);
}

TEST_F(LogPlayerTest, AtItsEndItStopsAndPlayBeginsAnew) {
  LogPlayer player(log_, "LIO_", hub_);
  player.Advance(100.0);
  player.Advance(0.0);
  EXPECT_EQ(PathRows(), 101U);
  EXPECT_FALSE(TimelineNow().is_playing);
  EXPECT_NEAR(TimelineNow().t_s, 10.0, 1e-6);
  player.Play();
  player.Advance(0.0);
  EXPECT_EQ(PathRows(), 1U);
}

TEST_F(LogPlayerTest, OrdersThatCannotBeAreClamped) {
  LogPlayer player(log_, "LIO_", hub_);
  player.Pause();
  player.Seek(-5.0);
  player.Advance(0.0);
  EXPECT_EQ(TimelineNow().t_s, 0.0);
  player.Seek(1e300);
  player.Advance(0.0);
  EXPECT_NEAR(TimelineNow().t_s, 10.0, 1e-6);
  player.Seek(std::numeric_limits<double>::quiet_NaN());
  player.SetSpeed(-3.0);
  player.Advance(0.0);
  EXPECT_EQ(TimelineNow().t_s, 0.0);
  EXPECT_EQ(TimelineNow().speed, LogPlayer::kMinSpeed);
  player.SetSpeed(std::numeric_limits<double>::quiet_NaN());
  player.Advance(0.0);
  EXPECT_EQ(TimelineNow().speed, 1.0);
}

TEST_F(LogPlayerTest, ManyMessagesAreShownInTurnsBetweenWhichOrdersAreHeard) {
  EventLogWriter writer(log_);
  for (int i = 0; i < 5000; ++i) {
    writer.Write(UtimeAt(1e-3 * i), "LIO_ODOM", EncodeOdometry(NavAt(0.1 * i)));
  }
  writer.Close();
  LogPlayer player(log_, "LIO_", hub_);
  player.Pause();
  player.Seek(10.0);
  player.Advance(0.0);
  EXPECT_TRUE(TimelineNow().is_seeking);
  for (int i = 0; i < 5; ++i) player.Advance(0.0);
  EXPECT_FALSE(TimelineNow().is_seeking);
  EXPECT_EQ(PathRows(), 5000U);
}

TEST_F(LogPlayerTest, StampsThatJumpAndLongSilencesAreNotWaitedFor) {
  EventLogWriter writer(log_);
  const std::int64_t utimes[] = {UtimeAt(0),    UtimeAt(1),
                                 UtimeAt(-1e6), std::numeric_limits<std::int64_t>::min(),
                                 UtimeAt(3),    std::numeric_limits<std::int64_t>::max(),
                                 UtimeAt(4)};
  for (const std::int64_t utime : utimes) {
    writer.Write(utime, "LIO_ODOM", EncodeOdometry(NavAt(0)));
  }
  writer.Close();
  const LogPlayer player(log_, "LIO_", hub_);
  EXPECT_LE(player.duration_s(), 3 * LogPlayer::kMaxSilence_s + 5.0);
}

TEST_F(LogPlayerTest, DamageIsGoneAround) {
  std::string bytes = test::ReadText(log_);
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 300; ++i) bytes[i] = '\x55';
  folder_.Write("log.lcm", bytes);
  LogPlayer player(log_, "LIO_", hub_);
  EXPECT_GE(player.num_messages(), 98U);
  player.Advance(100.0);
  player.Advance(0.0);
  EXPECT_GE(PathRows(), 98U);
}

TEST_F(LogPlayerTest, ALogWithoutOutputsIsRefusedWithWhatToDo) {
  try {
    const LogPlayer player(log_, "CAR_", hub_);
    FAIL() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("CAR_ODOM"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("lcm-logplayer"));
  }
}

}  // namespace
}  // namespace lio
