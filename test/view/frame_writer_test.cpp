// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/frame_writer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "view/frame_reader.hpp"

namespace lio {
namespace {

using test::Sections;

std::vector<Eigen::Vector3f> ThroughTheWire(const std::vector<Eigen::Vector3f>& points) {
  FrameWriter writer;
  writer.Begin(Section::kScan);
  writer.PutPoints(points);
  writer.End();
  const Bytes frame = writer.Take();
  return Sections(frame).at(Section::kScan).Points();
}

TEST(FrameWriter, SectionsAreFoundAndPadded) {
  FrameWriter writer;
  EXPECT_TRUE(writer.is_empty());
  writer.Text(Section::kHello, "12345");
  writer.Begin(Section::kMap);
  writer.Put(std::uint32_t{7});
  writer.Put(1.5);
  writer.End();
  EXPECT_FALSE(writer.is_empty());
  const Bytes frame = writer.Take();
  EXPECT_EQ(frame.size(), 4U + 8U + 8U + 8U + 12U);
  auto sections = Sections(frame);
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_EQ(sections.at(Section::kHello).Text(), "12345");
  EXPECT_EQ(sections.at(Section::kMap).U32(), 7U);
  EXPECT_EQ(sections.at(Section::kMap).Read<double>(), 1.5);
}

TEST(FrameWriter, PointsArriveToHalfAStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-100.0F, 100.0F);
  std::vector<Eigen::Vector3f> points(1000);
  for (auto& point : points) point = {coordinate(random), coordinate(random), coordinate(random)};
  const auto got = ThroughTheWire(points);
  ASSERT_EQ(got.size(), points.size());
  const float half_step = 0.5F * 200.0F / 65535.0F;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((got[i] - points[i]).cwiseAbs().maxCoeff(), half_step + 1e-4F);
  }
}

TEST(FrameWriter, OnePointAndNoneArriveAsTheyAre) {
  EXPECT_TRUE(ThroughTheWire({}).empty());
  const Eigen::Vector3f point(1e5F, -2e5F, 3.0F);
  const auto got = ThroughTheWire({point});
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0], point);
}

}  // namespace
}  // namespace lio
