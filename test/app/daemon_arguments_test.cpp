// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/daemon_arguments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace lio {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Parses the words as liod would; `error` is set to what is wrong with them.
struct Parsed {
  explicit Parsed(std::vector<std::string> words) {
    CLI::App app("", "liod");
    arguments.AddTo(app);
    help = app.help();
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
      app.parse(words);
    } catch (const CLI::ParseError& fault) {
      error = fault.what();
    }
    live = arguments.Live();
  }
  DaemonArguments arguments;
  LiveOptions live;
  std::string help, error;
};

TEST(DaemonArguments, WithoutAnyItPublishesUnderItsOwnNamesAndWritesNothing) {
  const Parsed parsed({});
  EXPECT_EQ(parsed.error, "");
  EXPECT_EQ(parsed.arguments.lcm_url, "");
  EXPECT_FALSE(parsed.live.out);
  EXPECT_FALSE(parsed.live.writes_map);
  EXPECT_FALSE(parsed.live.publishes_full_cloud);
  EXPECT_EQ(parsed.live.channels.imu, "LIO_IMU");
  EXPECT_EQ(parsed.live.channels.odometry_imu_rate, "LIO_ODOM_IMU");
}

TEST(DaemonArguments, EachReachesItsPlace) {
  const Parsed parsed({"--lcm-url", "udpm://239.255.76.67:7700", "--out", "out/live", "--map",
                       "--cloud-full", "--channel-prefix", "CAR_", "--config", "rig.yaml", "--set",
                       "ndt.voxel_m=2"});
  EXPECT_EQ(parsed.error, "");
  EXPECT_EQ(parsed.arguments.lcm_url, "udpm://239.255.76.67:7700");
  EXPECT_EQ(parsed.live.out, "out/live");
  EXPECT_TRUE(parsed.live.writes_map);
  EXPECT_TRUE(parsed.live.publishes_full_cloud);
  EXPECT_EQ(parsed.live.channels.scan, "CAR_SCAN");
  EXPECT_EQ(parsed.live.channels.status, "CAR_STATUS");
  EXPECT_THAT(parsed.arguments.options.files, ElementsAre("rig.yaml"));
  EXPECT_THAT(parsed.arguments.options.sets, ElementsAre("ndt.voxel_m=2"));
}

TEST(DaemonArguments, AMapNeedsAFolderToGoTo) {
  EXPECT_FALSE(Parsed({"--map"}).live.writes_map);
  EXPECT_FALSE(Parsed({"--map", "--out", ""}).live.writes_map);
  EXPECT_TRUE(Parsed({"--map", "--out", "x"}).live.writes_map);
}

// LCM's channel names have at most 63 characters: a prefix of 40 leaves room for liod's longest.
TEST(DaemonArguments, APrefixLeavesRoomForTheChannelsName) {
  const Parsed longest({"--channel-prefix", std::string(40, 'a')});
  EXPECT_EQ(longest.error, "");
  const Channels& channels = longest.live.channels;
  for (const std::string* name :
       {&channels.imu, &channels.scan, &channels.command, &channels.odometry,
        &channels.odometry_imu_rate, &channels.state, &channels.registration, &channels.status,
        &channels.cloud, &channels.cloud_full}) {
    EXPECT_LE(name->size(), 63u) << *name;
  }
  for (const std::string& name : channels.features) EXPECT_LE(name.size(), 63u) << name;
  EXPECT_THAT(Parsed({"--channel-prefix", std::string(41, 'a')}).error,
              AllOf(HasSubstr("--channel-prefix"), HasSubstr("40")));
}

TEST(DaemonArguments, WordsThatAreNoneAreRefused) {
  EXPECT_NE(Parsed({"drive.lcm"}).error, "");
  EXPECT_NE(Parsed({"--cloud"}).error, "");
  EXPECT_NE(Parsed({"--out"}).error, "");
}

TEST(DaemonArguments, HelpTeaches) {
  EXPECT_THAT(Parsed({}).help,
              AllOf(HasSubstr("LIO_IMU and LIO_SCAN"), HasSubstr("Examples:"),
                    HasSubstr("--lcm-url"), HasSubstr("sudo ip route add 224.0.0.0/4 dev lo"),
                    HasSubstr("4 no transport"), HasSubstr("70 internal fault")));
}

}  // namespace
}  // namespace lio
