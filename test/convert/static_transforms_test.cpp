// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/static_transforms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr Timestamp kTransformStamp{1'700'000'000'000'000'000};

// Returns a quarter turn about z, and a shift.
Pose Mounted(const Vector3& translation) {
  return {Quaternion(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), translation};
}

std::vector<std::uint8_t> TransformMessage(const std::vector<FrameLink>& links,
                                           test::RosBytes bytes = test::RosBytes()) {
  bytes.Put(static_cast<std::uint32_t>(links.size()));
  for (const FrameLink& link : links) {
    bytes.PutHeader(kTransformStamp, link.parent).PutString(link.child);
    for (const double value : link.T_parent_child.translation) bytes.Put(value);
    for (const double value : link.T_parent_child.rotation.coeffs()) bytes.Put(value);
  }
  return bytes.bytes();
}

class StaticTransforms : public ::testing::TestWithParam<RosEncoding> {};

TEST_P(StaticTransforms, AreDecodedInEitherEncoding) {
  const auto links = DecodeRosTransforms(
      TransformMessage({{"/base", "imu", Mounted({1, 2, 3})}, {"base", "lidar", {}}},
                       test::RosBytes(GetParam())),
      GetParam());
  ASSERT_TRUE(links);
  ASSERT_EQ(links->size(), 2u);
  EXPECT_EQ(links->at(0).parent, "base");
  EXPECT_EQ(links->at(0).child, "imu");
  EXPECT_EQ(links->at(0).T_parent_child.translation, Vector3(1, 2, 3));
  EXPECT_NEAR(YawOf(links->at(0).T_parent_child.rotation), M_PI / 2, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Encodings, StaticTransforms,
                         ::testing::Values(RosEncoding::kRos1, RosEncoding::kCdr));

TEST(StaticTransforms, EveryTruncationIsRefused) {
  const auto bytes = TransformMessage({{"base", "imu", Mounted({1, 2, 3})}});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeRosTransforms(ByteView(bytes).first(size), RosEncoding::kRos1)) << size;
  }
}

TEST(FrameTree, JoinsTwoBranches) {
  FrameTree tree;
  tree.Add({"base", "imu", Mounted({1, 0, 0})});
  tree.Add({"base", "mast", {Quaternion::Identity(), Vector3(0, 0, 2)}});
  tree.Add({"mast", "lidar", {Quaternion::Identity(), Vector3(0, 3, 0)}});
  const auto T_imu_lidar = tree.Find("imu", "lidar");
  ASSERT_TRUE(T_imu_lidar);
  // In base the lidar is at 0 3 2, the IMU at 1 0 0 and turned by 90 deg: its x is base's y.
  EXPECT_LT((T_imu_lidar->translation - Vector3(3, 1, 2)).norm(), 1e-12);
  EXPECT_FALSE(tree.Find("imu", "camera"));
}

TEST(FrameTree, ALoopOfFramesEnds) {
  FrameTree tree;
  tree.Add({"a", "b", {}});
  tree.Add({"b", "a", {}});
  EXPECT_FALSE(tree.Find("a", "c"));
}

TEST(FindMounting, TakesTheFramesOfTheSensorsMessages) {
  const test::TempDir dir;
  test::Bag1Writer bag(dir.path() / "drive.bag");
  ImuSample sample;
  sample.stamp = kTransformStamp;
  test::RosBytes cloud_begin;
  cloud_begin.PutHeader(kTransformStamp, "lidar");
  bag.Write(
      "/tf_static", "tf2_msgs/TFMessage", kTransformStamp,
      TransformMessage({{"imu_link", "lidar", {}}, {"imu_link", "lidar", Mounted({0, 0, 1})}}));
  bag.Write("/points", "sensor_msgs/PointCloud2", kTransformStamp, cloud_begin.bytes());
  bag.Write("/imu", "sensor_msgs/Imu", kTransformStamp, test::ImuMessage(sample));
  bag.Close();
  const MountedSensors mounted = FindMounting(dir.path() / "drive.bag", "/points", "/imu");
  EXPECT_EQ(mounted.lidar_frame, "lidar");
  EXPECT_EQ(mounted.imu_frame, "imu_link");
  EXPECT_TRUE(mounted.has_static_transforms);
  ASSERT_TRUE(mounted.T_imu_lidar);
  EXPECT_EQ(mounted.T_imu_lidar->translation, Vector3(0, 0, 1));
}

}  // namespace
}  // namespace lio
