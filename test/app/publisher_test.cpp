// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/publisher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Remembers channels and message sizes; refuses when told to.
class RecordingBus final : public Bus {
 public:
  void Subscribe(const std::string&, int, Handler) override {}
  ReceiveResult Receive(std::chrono::milliseconds) override { return ReceiveResult::kTimeout; }
  bool Publish(const std::string& channel, ByteView data) override {
    channels.push_back(channel);
    largest = std::max(largest, data.size());
    return !refuses;
  }
  std::int64_t num_oversized() const override { return 0; }
  std::int64_t num_handler_faults() const override { return 0; }

  std::vector<std::string> channels;
  std::size_t largest = 0;
  bool refuses = false;
};

class PublisherTest : public ::testing::Test {
 protected:
  RecordingBus bus_;
  Channels channels_;
  Publisher publisher_{bus_, channels_};
};

TEST_F(PublisherTest, AScanGivesOdometryStateAndRegistration) {
  ScanOutput output;
  output.filter.emplace().cov = Eigen::MatrixXd::Identity(21, 21);
  publisher_.Publish(Output(output));
  EXPECT_THAT(bus_.channels, ElementsAre("LIO_ODOM", "LIO_ODOM_LOCAL", "LIO_STATE", "LIO_REG"));
}

TEST_F(PublisherTest, BeforeTheStartAScanGivesRegistrationOnly) {
  publisher_.Publish(Output(ScanOutput{}));
  EXPECT_THAT(bus_.channels, ElementsAre("LIO_REG"));
}

TEST_F(PublisherTest, InertialSamplesHaveAChannelOfTheirOwn) {
  NavOutput nav;
  nav.source = OdometrySource::kImuPropagated;
  publisher_.Publish(Output(nav));
  EXPECT_THAT(bus_.channels, ElementsAre("LIO_ODOM_IMU"));
}

TEST_F(PublisherTest, TheBaseFrameHasChannelsOfItsOwn) {
  ScanOutput scan;
  scan.filter.emplace().nav.base.emplace();
  publisher_.Publish(Output(scan));
  NavOutput nav;
  nav.source = OdometrySource::kImuPropagated;
  nav.base.emplace();
  publisher_.Publish(Output(nav));
  EXPECT_THAT(bus_.channels, ElementsAre("LIO_ODOM", "LIO_ODOM_BASE", "LIO_ODOM_LOCAL", "LIO_STATE",
                                         "LIO_REG", "LIO_ODOM_IMU", "LIO_ODOM_BASE_IMU"));
}

TEST_F(PublisherTest, EachFeatureSetHasAChannelOfItsOwn) {
  for (std::size_t i = 0; i < kNumFeatureSets; ++i) {
    publisher_.PublishFeatures(static_cast<FeatureSet>(i), ScanChunk{});
  }
  EXPECT_THAT(bus_.channels, ElementsAre("LIO_CORNER_SHARP", "LIO_CORNER_LESS_SHARP",
                                         "LIO_SURF_FLAT", "LIO_SURF_LESS_FLAT", "LIO_REMOVED"));
}

TEST_F(PublisherTest, NoticesAreNotMessages) {
  publisher_.Publish(Output(Notice{}));
  EXPECT_THAT(bus_.channels, IsEmpty());
}

TEST_F(PublisherTest, TheLargestCloudIsBelowSixtyKilobytes) {
  publisher_.Publish(
      RegisteredCloud{Timestamp{1}, 0, std::vector<Eigen::Vector3f>(Publisher::kMaxCloudPoints)});
  EXPECT_LE(bus_.largest, 60u * 1024u);
}

TEST_F(PublisherTest, WhatTheBusRefusesIsCounted) {
  bus_.refuses = true;
  publisher_.Publish(Output(ScanOutput{}));
  publisher_.Publish(StatusReport{}, "1.0.0");
  EXPECT_EQ(publisher_.num_failed(), 2);
}

}  // namespace
}  // namespace lio
