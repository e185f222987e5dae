// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/input_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A daemon whose clock is turned by hand; it looks once a second.
class InputWatchTest : public ::testing::Test {
 protected:
  // Returns what is told within so many seconds, with new messages in each.
  std::vector<std::string> Pass(int seconds, int num_imu, int num_chunks) {
    std::vector<std::string> told;
    for (int i = 0; i < seconds; ++i) {
      now_ += std::chrono::seconds(1);
      InputCounters& input = report_.input;
      input.num_imu_received += num_imu;
      input.num_imu_taken += num_imu;
      input.num_chunks_received += num_chunks;
      input.num_chunks_taken += num_chunks;
      for (const InputRemark& remark : watch_.Look(report_, others_, now_)) {
        told.push_back((remark.is_fault ? "" : "over: ") + remark.text);
      }
    }
    return told;
  }

  InputWatch::Clock::time_point now_{};
  StatusReport report_;
  OtherDaemons::Heard others_;
  InputWatch watch_{{"A_IMU", "A_SCAN", "A_STATUS", "udpm://239.1.2.3:7700?ttl=0", true}, now_};
};

TEST_F(InputWatchTest, ASoundStreamIsNotSpokenOf) {
  EXPECT_TRUE(Pass(100, 100, 20).empty());
  EXPECT_EQ(watch_.standing(), "");
}

TEST_F(InputWatchTest, SilenceIsToldOnceWithWhatToLookAt) {
  EXPECT_TRUE(Pass(4, 0, 0).empty()) << "drivers may start later";
  const auto told = Pass(600, 0, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("A_IMU and A_SCAN"), HasSubstr("udpm://239.1.2.3:7700"),
                             HasSubstr("ip route get 239.1.2.3"), HasSubstr("ttl=1")));
  EXPECT_EQ(watch_.standing(), told[0]);
}

TEST_F(InputWatchTest, ItIsToldAgainOnlyAfterItHadPassed) {
  EXPECT_EQ(Pass(10, 0, 0).size(), 1u);
  for (int i = 0; i < 10; ++i) {  // one message now and then is no recovery
    EXPECT_TRUE(Pass(1, 1, 1).empty());
    EXPECT_TRUE(Pass(9, 0, 0).empty());
  }
  const auto over = Pass(10, 100, 20);
  ASSERT_EQ(over.size(), 1u);
  EXPECT_THAT(over[0], HasSubstr("over: no longer so: nothing comes on A_IMU and A_SCAN"));
  EXPECT_EQ(watch_.standing(), "");
  EXPECT_EQ(Pass(10, 0, 0).size(), 1u);
}

TEST_F(InputWatchTest, TheSensorThatIsMissingIsNamed) {
  auto told = Pass(10, 100, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("no scans on A_SCAN"), Not(HasSubstr("A_IMU"))));
  told = Pass(10, 100, 20);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("over: "));
  told = Pass(10, 0, 20);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("no inertial samples on A_IMU"), HasSubstr("use_imu")));
}

TEST_F(InputWatchTest, WithoutAnImuNobodyMissesIt) {
  watch_ = InputWatch({"A_IMU", "A_SCAN", "A_STATUS", "tcpq://", false}, now_);
  EXPECT_TRUE(Pass(20, 0, 20).empty());
  const auto told = Pass(20, 0, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("on A_SCAN over tcpq://"), HasSubstr("same server")));
}

TEST_F(InputWatchTest, MessagesOfAnotherTypeAreNoSilence) {
  report_.input.num_imu_received = 500;
  const auto told = Pass(10, 0, 0);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("500 messages were refused"));
}

TEST_F(InputWatchTest, LossesAreToldByTheirPlace) {
  EXPECT_TRUE(Pass(10, 100, 20).empty());
  report_.num_kernel_dropped = 3;
  auto told = Pass(4, 100, 20);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("kernel drops"), HasSubstr("net.core.rmem_max")));
  EXPECT_EQ(told[0].find('\n'), std::string::npos);
  EXPECT_EQ(Pass(10, 100, 20).size(), 1u) << "it has passed";
  for (int i = 0; i < 30; ++i) {
    ++report_.counters.num_scans_dropped;
    told = Pass(1, 100, 20);
    ASSERT_EQ(told.size(), i == 0 ? 1u : 0u);
    EXPECT_THAT(watch_.standing(), HasSubstr("scans are dropped"));
  }
}

TEST_F(InputWatchTest, AStoppedProcessHasMissedNothing) {
  EXPECT_TRUE(Pass(10, 100, 20).empty());
  now_ += std::chrono::hours(1);
  EXPECT_TRUE(Pass(1, 0, 0).empty());
}

TEST_F(InputWatchTest, ASecondDaemonIsToldOnceAndTakenBackWhenItIsSilent) {
  std::vector<std::string> told;
  for (int i = 0; i < 20; ++i) {
    others_ = {others_.num + 1, 1234567};
    for (std::string& text : Pass(1, 100, 20)) told.push_back(std::move(text));
  }
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], AllOf(HasSubstr("another liod publishes on A_STATUS"), HasSubstr("1234567"),
                             HasSubstr("--channel-prefix")));
  EXPECT_EQ(watch_.standing(), told[0]);
  EXPECT_TRUE(Pass(4, 100, 20).empty()) << "its next status may still come";
  EXPECT_THAT(Pass(2, 100, 20),
              testing::ElementsAre("over: no longer so: another liod publishes on A_STATUS and the "
                                   "other channels of this one"));
  EXPECT_EQ(watch_.standing(), "");
}

}  // namespace
}  // namespace lio
