// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/gathered_cloud.hpp"

#include <gtest/gtest.h>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::Points;

const Pose kAhead{Quaternion::Identity(), Vector3(10, 0, 0)};

TEST(GatheredCloud, ScansThatShowTheSameAddNothing) {
  Points points;
  test::AddPost({5.f, 5.f}, {0.f, 0.f}, points);
  GatheredCloud cloud;
  cloud.Add(points, Pose::Identity());
  const std::size_t num = cloud.SampleAround(Vector3::Zero()).points.size();
  EXPECT_EQ(num, points.size()) << "0.3 m apart";
  cloud.Add(points, Pose::Identity());
  EXPECT_EQ(cloud.SampleAround(Vector3::Zero()).points.size(), num);
}

TEST(GatheredCloud, ASampleHasWhatIsNearInTheMapsAxes) {
  Points points;
  test::AddColumn({5.5f, 5.5f}, points);
  test::AddColumn({45.f, 0.f}, points);
  GatheredCloud cloud;
  cloud.Add(points, kAhead);
  const CloudSample sample = cloud.SampleAround(kAhead.translation);
  ASSERT_FALSE(sample.structures.empty());
  for (const Eigen::Vector2f& structure : sample.structures) {
    EXPECT_LT((structure - Eigen::Vector2f(15.5f, 5.5f)).norm(), 0.25f);
  }
  ASSERT_FALSE(sample.points.empty());
  for (const Eigen::Vector3f& point : sample.points) {
    EXPECT_LT((point.head<2>() - Eigen::Vector2f(5.5f, 5.5f)).norm(), 0.25f);
  }
  EXPECT_EQ(sample.centre_map, kAhead.translation);
}

TEST(GatheredCloud, EmptyCloudGivesAnEmptySample) {
  const CloudSample sample = GatheredCloud().SampleAround(Vector3::Zero());
  EXPECT_TRUE(sample.structures.empty());
  EXPECT_TRUE(sample.points.empty());
}

}  // namespace
}  // namespace lio
