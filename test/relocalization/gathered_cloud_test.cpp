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
  EXPECT_EQ(num, points.size());
  cloud.Add(points, Pose::Identity());
  EXPECT_EQ(cloud.SampleAround(Vector3::Zero()).points.size(), num);
}

TEST(GatheredCloud, ASampleHasWhatIsNearInTheMapsAxes) {
  Points points;
  test::AddPost({5.f, 5.f}, {0.f, 0.f}, points);
  test::AddPost({45.f, 0.f}, {0.f, 0.f}, points);
  GatheredCloud cloud;
  cloud.Add(points, kAhead);
  const CloudSample sample = cloud.SampleAround(kAhead.translation);
  ASSERT_EQ(sample.structures.size(), 1u);
  EXPECT_LT((sample.structures[0] - Eigen::Vector2f(15.f, 5.f)).norm(), 1e-4f);
  ASSERT_EQ(sample.points.size(), 8u) << "the other post is 45 m off";
  EXPECT_LT((sample.points[0].head<2>() - Eigen::Vector2f(5.f, 5.f)).norm(), 1e-4f);
  EXPECT_EQ(sample.centre_map, kAhead.translation);
}

TEST(GatheredCloud, EmptyCloudGivesAnEmptySample) {
  const CloudSample sample = GatheredCloud().SampleAround(Vector3::Zero());
  EXPECT_TRUE(sample.structures.empty());
  EXPECT_TRUE(sample.points.empty());
}

}  // namespace
}  // namespace lio
