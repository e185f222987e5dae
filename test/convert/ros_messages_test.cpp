// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_messages.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

using test::RosBytes;
using test::RosForm;

constexpr Timestamp kHeaderStamp{1'556'268'000'123'456'789};

class RosMessages : public testing::TestWithParam<RosForm> {
 protected:
  RosEncoding encoding() const { return GetParam().encoding; }
  RosBytes Bytes() const { return RosBytes(GetParam().encoding, GetParam().big_endian); }

  // Every truncation and every surplus of bytes must be refused.
  template <typename Decode>
  void ExpectOnlyWhole(const std::vector<std::uint8_t>& message, Decode decode) {
    EXPECT_TRUE(decode(message, encoding()).has_value());
    for (std::size_t size = 0; size < message.size(); ++size) {
      EXPECT_FALSE(decode(ByteView(message).first(size), encoding()).has_value()) << size;
    }
    std::vector<std::uint8_t> longer = message;
    longer.resize(message.size() + 8);
    EXPECT_FALSE(decode(longer, encoding()).has_value());
  }
};

TEST_P(RosMessages, ImuKeepsStampRateAndForce) {
  const ImuSample sample{kHeaderStamp, {0.1, -0.2, 0.3}, {1.0, 2.0, 9.8}};
  const auto decoded = DecodeRosImu(test::ImuMessage(sample, Bytes()), encoding());
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->stamp, kHeaderStamp);
  EXPECT_EQ(decoded->w_imu_radps, sample.w_imu_radps);
  EXPECT_EQ(decoded->f_imu_mps2, sample.f_imu_mps2);
  ExpectOnlyWhole(test::ImuMessage(sample, Bytes()), DecodeRosImu);
}

TEST_P(RosMessages, CloudKeepsFieldsAndData) {
  const auto points = test::SeePoints({.num_rings = 2, .num_columns = 3}, 0);
  const test::TestCloud cloud = test::VelodyneCloud(kHeaderStamp, points);
  const auto message = test::CloudMessage(cloud, Bytes());
  const auto decoded = DecodeRosCloud(message, encoding());
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->stamp, kHeaderStamp);
  EXPECT_EQ(decoded->num_points(), 6u);
  EXPECT_EQ(decoded->fields, cloud.fields);
  EXPECT_EQ(decoded->point_step, 22u);
  EXPECT_TRUE(
      std::equal(decoded->data.begin(), decoded->data.end(), cloud.data.begin(), cloud.data.end()));
  ExpectOnlyWhole(message, DecodeRosCloud);
}

TEST_P(RosMessages, PosesKeepPositionAndAttitude) {
  const StampedPose pose{kHeaderStamp, {ExpSo3({0.1, 0.2, 0.3}), {4.0, 5.0, 6.0}}};
  for (const bool odometry : {false, true}) {
    const auto message =
        odometry ? test::OdometryMessage(pose, Bytes()) : test::PoseMessage(pose, Bytes());
    const auto decode = odometry ? DecodeRosOdometry : DecodeRosPoseStamped;
    const auto decoded = decode(message, encoding());
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->stamp, kHeaderStamp);
    EXPECT_EQ(decoded->pose.translation, pose.pose.translation);
    EXPECT_NEAR(decoded->pose.rotation.angularDistance(pose.pose.rotation), 0.0, 1e-15);
    ExpectOnlyWhole(message, decode);
  }
}

INSTANTIATE_TEST_SUITE_P(Encodings, RosMessages,
                         testing::Values(RosForm{RosEncoding::kRos1, false},
                                         RosForm{RosEncoding::kCdr, false},
                                         RosForm{RosEncoding::kCdr, true}));

TEST(RosPose, RefusesWhatIsNoRotation) {
  StampedPose pose{kHeaderStamp, {}};
  pose.pose.rotation.coeffs() << 0.0, 0.0, 0.0, 0.0;
  EXPECT_FALSE(DecodeRosPoseStamped(test::PoseMessage(pose), RosEncoding::kRos1));
  pose.pose.rotation.setIdentity();
  pose.pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DecodeRosPoseStamped(test::PoseMessage(pose), RosEncoding::kRos1));
}

class RosCloudSizes : public testing::Test {
 protected:
  test::TestCloud cloud_ =
      test::VelodyneCloud(kHeaderStamp, test::SeePoints({.num_rings = 2, .num_columns = 4}, 0));

  bool IsAccepted() const {
    return DecodeRosCloud(test::CloudMessage(cloud_), RosEncoding::kRos1).has_value();
  }
};

TEST_F(RosCloudSizes, AreAcceptedWhenTheyAgree) {
  EXPECT_TRUE(IsAccepted());
}

TEST_F(RosCloudSizes, AreRefusedWhenDataIsShort) {
  cloud_.data.resize(cloud_.data.size() - 1);
  EXPECT_FALSE(IsAccepted());
}

TEST_F(RosCloudSizes, AreRefusedWhenAFieldLeavesThePoint) {
  cloud_.fields.back().offset = 19;
  EXPECT_FALSE(IsAccepted());
  cloud_.fields.back().offset = 0xfffffffe;
  EXPECT_FALSE(IsAccepted());
}

TEST_F(RosCloudSizes, AreRefusedWhenWidthIsHostile) {
  cloud_.width = 0xffffffff;
  EXPECT_FALSE(IsAccepted());
  cloud_.height = 0xffffffff;
  EXPECT_FALSE(IsAccepted());
}

TEST_F(RosCloudSizes, AreRefusedWhenThePointStepIsZero) {
  cloud_.point_step = 0;
  cloud_.row_step = 1;
  EXPECT_FALSE(IsAccepted());
}

TEST_F(RosCloudSizes, MayPadTheirRows) {
  cloud_.height = 2;
  cloud_.width = 4;
  cloud_.row_step = 100;
  cloud_.data.resize(200);
  EXPECT_TRUE(IsAccepted());
  cloud_.data.resize(100 + 88);  // the last row without padding
  EXPECT_TRUE(IsAccepted());
}

TEST(RosTypeName, OfRos2IsWrittenAsInRos1) {
  EXPECT_EQ(Ros1TypeName("sensor_msgs/msg/Imu"), "sensor_msgs/Imu");
  EXPECT_EQ(Ros1TypeName("sensor_msgs/Imu"), "sensor_msgs/Imu");
}

}  // namespace
}  // namespace lio
