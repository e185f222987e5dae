// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pcl_conversions.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace lio {
namespace {

constexpr Timestamp kStamp{1'700'000'000'000'000'000};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct VelodynePoint {  // as LIO-SAM and velodyne_pointcloud have it
  float x, y, z, intensity;
  std::uint16_t ring;
  float time;
};

struct OusterPoint {
  float x, y, z, intensity;
  std::uint32_t t;
  std::uint8_t ring;
};

struct HesaiPoint {
  float x, y, z;
  double timestamp;  // s since the epoch
};

TEST(PclConversions, FieldsAreTaken) {
  pcl::PointCloud<VelodynePoint> cloud;
  cloud.push_back({1, 2, 3, 7.4f, 5, 0.0f});
  cloud.push_back({4, 5, 6, 1e6f, 15, 0.05f});
  cloud.push_back({7, 8, 9, -3.0f, 0, 0.1f});
  const LidarSweep sweep = SweepFromPcl(cloud, kStamp);
  ASSERT_EQ(sweep.points.size(), 3u);
  EXPECT_EQ(sweep.stamp, kStamp);
  EXPECT_EQ(sweep.points[0].x_m, 1);
  EXPECT_EQ(sweep.points[0].y_m, 2);
  EXPECT_EQ(sweep.points[0].z_m, 3);
  EXPECT_EQ(sweep.points[0].intensity, 7);
  EXPECT_EQ(sweep.points[1].intensity, 65535);
  EXPECT_EQ(sweep.points[2].intensity, 0);
  EXPECT_EQ(sweep.points[1].ring, 15);
  EXPECT_NEAR(sweep.points[1].t_offset_ns, 50'000'000, 2);
  EXPECT_NEAR(sweep.points[2].t_offset_ns, 100'000'000, 5);
}

// Some drivers stamp the last point, and count to it.
TEST(PclConversions, TimesBeforeTheStampMoveTheStamp) {
  pcl::PointCloud<VelodynePoint> cloud;
  cloud.push_back({1, 0, 0, 0, 0, 0.0f});
  cloud.push_back({2, 0, 0, 0, 0, -0.125f});
  const LidarSweep sweep = SweepFromPcl(cloud, kStamp);
  EXPECT_EQ(sweep.stamp, kStamp - Duration{125'000'000});
  EXPECT_EQ(sweep.points[0].t_offset_ns, 125'000'000u);
  EXPECT_EQ(sweep.points[1].t_offset_ns, 0u);
}

TEST(PclConversions, IntegerTimesAreNanoseconds) {
  pcl::PointCloud<OusterPoint> cloud;
  cloud.push_back({1, 0, 0, 0, 30, 0});
  cloud.push_back({2, 0, 0, 0, 99'999'999, 127});
  const LidarSweep sweep = SweepFromPcl(cloud, kStamp);
  EXPECT_EQ(sweep.stamp, kStamp + Duration{30});
  EXPECT_EQ(sweep.points[1].t_offset_ns, 99'999'969u);
  EXPECT_EQ(sweep.points[1].ring, 127);
}

TEST(PclConversions, AFunctionTellsOtherTimes) {
  pcl::PointCloud<HesaiPoint> cloud;
  cloud.push_back({1, 0, 0, 100.0});
  cloud.push_back({2, 0, 0, 100.0625});
  const LidarSweep sweep =
      SweepFromPcl(cloud, kStamp, [](const HesaiPoint& p) { return p.timestamp - 100.0; });
  EXPECT_EQ(sweep.points[1].t_offset_ns, 62'500'000u);
  static_assert(pcl_detail::HasAmbiguousTime<HesaiPoint>);
  static_assert(!pcl_detail::HasAmbiguousTime<OusterPoint>);
  static_assert(!pcl_detail::HasAmbiguousTime<pcl::PointXYZI>);
}

TEST(PclConversions, AWrongUnitIsRefused) {
  pcl::PointCloud<VelodynePoint> cloud;
  cloud.push_back({1, 0, 0, 0, 0, 0.0f});
  cloud.push_back({2, 0, 0, 0, 0, 100.0f});  // milliseconds
  EXPECT_THROW(SweepFromPcl(cloud, kStamp), std::invalid_argument);
}

TEST(PclConversions, PointsThatAreNotFiniteAreLeftOut) {
  pcl::PointCloud<VelodynePoint> cloud;
  cloud.push_back({kNan, 0, 0, 0, 0, -100.0f});
  cloud.push_back({1, 0, 0, 0, 3, 0.01f});
  cloud.push_back({1, 0, 0, 0, 0, kNan});
  const LidarSweep sweep = SweepFromPcl(cloud, kStamp);
  ASSERT_EQ(sweep.points.size(), 1u);
  EXPECT_EQ(sweep.points[0].ring, 3);
  EXPECT_EQ(sweep.points[0].t_offset_ns, 0u);
  EXPECT_TRUE(SweepFromPcl(pcl::PointCloud<pcl::PointXYZ>(), kStamp).points.empty());
}

TEST(PclConversions, TypesWithoutTimeAreOneInstant) {
  pcl::PointCloud<pcl::PointXYZI> cloud;
  cloud.push_back(pcl::PointXYZI(1, 2, 3, 4));
  const LidarSweep sweep = SweepFromPcl(cloud, kStamp);
  EXPECT_EQ(sweep.stamp, kStamp);
  EXPECT_EQ(sweep.points[0].t_offset_ns, 0u);
  EXPECT_EQ(sweep.points[0].intensity, 4);
}

TEST(PclConversions, StampsOfPclAreMicroseconds) {
  pcl::PCLHeader header;
  header.stamp = 1'700'000'000'123'456;
  EXPECT_EQ(StampFromPcl(header).ns, 1'700'000'000'123'456'000);
}

TEST(PclConversions, CloudsAndPosesGoBack) {
  const std::vector<Eigen::Vector3f> points = {{1, 2, 3}, {4, 5, 6}};
  const auto cloud = CloudToPcl<pcl::PointXYZI>(points);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud[1].getVector3fMap(), points[1]);

  const Pose pose{Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitZ())), {1, 2, 3}};
  const Vector3 point(0.5, -1.0, 2.0);
  EXPECT_TRUE((AffineFromPose(pose) * point).isApprox(pose * point, 1e-12));
}

}  // namespace
}  // namespace lio
