// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/client_frame.hpp"

#include <gtest/gtest.h>

#include "view/frame_reader.hpp"
#include "view/view_fixture.hpp"

namespace lio {
namespace {

using test::CloudOf;
using test::NavAt;
using test::Sections;
using test::UtimeAt;

// A client that was told the status just now, so that only what changed is due.
class ClientFrame : public ::testing::Test {
 protected:
  ClientFrame() { (void)NextFrame(view_, UtimeAt(0), cursor_); }

  Bytes Next(const FrameBudget& budget = {}) {
    return NextFrame(view_, UtimeAt(0), cursor_, budget).value_or(Bytes());
  }

  ViewState view_;
  ClientCursor cursor_;
};

TEST_F(ClientFrame, WithoutNewsThereIsNone) {
  EXPECT_FALSE(NextFrame(view_, UtimeAt(0.1), cursor_).has_value());
}

TEST_F(ClientFrame, AStatusIsDueTwiceASecondThoughNothingCame) {
  const auto frame = NextFrame(view_, UtimeAt(0.6), cursor_);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(Sections(*frame).size(), 1U);
  EXPECT_EQ(Sections(*frame).count(Section::kStatus), 1U);
}

TEST_F(ClientFrame, OnlyNewPointsOfTheMapAreSent) {
  view_.OnCloud(CloudOf(1, 100), UtimeAt(0), false);
  Bytes frame = Next();
  auto map = Sections(frame).at(Section::kMap);
  const std::uint32_t generation = map.U32();
  EXPECT_EQ(map.U32(), 0U);    // first
  EXPECT_EQ(map.U32(), 100U);  // in all
  EXPECT_FLOAT_EQ(map.F32(), 0.2F);
  EXPECT_EQ(map.Points().size(), 100U);
  EXPECT_TRUE(map.is_at_end());

  view_.OnCloud(CloudOf(2, 100, 30.0F), UtimeAt(0), false);
  frame = Next();
  map = Sections(frame).at(Section::kMap);
  EXPECT_EQ(map.U32(), generation);
  EXPECT_EQ(map.U32(), 100U);
  EXPECT_EQ(map.U32(), 130U);
  (void)map.F32();
  const auto points = map.Points();
  ASSERT_EQ(points.size(), 30U);
  EXPECT_NEAR(points.front().x(), 100.5F, 0.01F);
}

TEST_F(ClientFrame, AClientThatComesLaterGetsAllOfItInPieces) {
  view_.OnCloud(CloudOf(1, 100), UtimeAt(0), false);
  ClientCursor late;
  const FrameBudget budget{.max_map_points = 40, .max_rows = 10};
  std::vector<std::size_t> sizes;
  while (const auto frame = NextFrame(view_, UtimeAt(0), late, budget)) {
    auto sections = Sections(*frame);
    if (sections.count(Section::kMap) == 0) break;
    auto map = sections.at(Section::kMap);
    for (int i = 0; i < 4; ++i) (void)map.U32();
    sizes.push_back(map.Points().size());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{40, 40, 20}));
}

TEST_F(ClientFrame, AnotherGenerationBeginsAtTheFirstPoint) {
  view_.OnCloud(CloudOf(1, 100), UtimeAt(0), false);
  (void)Next();
  view_.Clear();
  Bytes frame = Next();
  auto map = Sections(frame).at(Section::kMap);
  EXPECT_EQ(map.U32(), view_.map_generation());
  EXPECT_EQ(map.U32(), 0U);
  EXPECT_EQ(map.U32(), 0U);
  (void)map.F32();
  EXPECT_TRUE(map.Points().empty());
  EXPECT_TRUE(Next().empty());
}

TEST_F(ClientFrame, PathAndStatesGrowByTheirNewRows) {
  FilterReport report;
  for (int i = 0; i < 5; ++i) {
    view_.OnOdometry(NavAt(i), UtimeAt(i));
    report.nav = NavAt(i);
    report.nav.v_world_imu_mps.x() = i;
    view_.OnFilterState(report);
    (void)Next();
  }
  view_.OnOdometry(NavAt(5), UtimeAt(5));
  report.nav = NavAt(5);
  report.nav.v_world_imu_mps.x() = 5;
  view_.OnFilterState(report);
  const Bytes frame = Next();
  auto path = Sections(frame).at(Section::kPath);
  (void)path.U32();
  EXPECT_EQ(path.U32(), 5U);
  EXPECT_EQ(path.U32(), 6U);
  EXPECT_EQ(path.U32(), 1U);
  EXPECT_EQ(path.F32(), 5.0F);
  auto states = Sections(frame).at(Section::kStates);
  for (int i = 0; i < 4; ++i) (void)states.U32();
  EXPECT_NEAR(states.Read<double>(), 1e-6 * static_cast<double>(test::kStart_us), 1e-6);
  EXPECT_NEAR(states.F32(), 5.0F, 1e-3F);
  EXPECT_EQ(states.F32(), 5.0F);
}

TEST_F(ClientFrame, ASlowClientGetsTheNewestAndTheRestIsCounted) {
  view_.OnOdometry(NavAt(0), UtimeAt(0));
  view_.OnCloud(CloudOf(1, 10), UtimeAt(0), false);
  (void)Next();
  for (int i = 1; i <= 100; ++i) {
    view_.OnOdometry(NavAt(0.01 * i, OdometrySource::kImuPropagated), UtimeAt(0.01 * i));
  }
  for (int i = 2; i <= 4; ++i) view_.OnCloud(CloudOf(i, i), UtimeAt(1), false);
  const Bytes frame = Next();
  auto pose = Sections(frame).at(Section::kPose);
  EXPECT_NEAR(pose.Read<double>(), 1e-6 * static_cast<double>(UtimeAt(1)), 1e-6);
  (void)pose.Read<double>();
  EXPECT_NEAR(pose.F32(), 1.0F, 1e-6F);
  EXPECT_EQ(cursor_.num_poses_left_out, 99U);
  auto scan = Sections(frame).at(Section::kScan);
  (void)scan.U32();
  EXPECT_EQ(scan.U32(), 2U);
  EXPECT_EQ(scan.Points().size(), 4U);
  EXPECT_LT(frame.size(), 2000U);  // it does not grow with what was missed
}

TEST_F(ClientFrame, PoseHasTheLayoutThatThePageReads) {
  view_.OnOdometry(NavAt(3), UtimeAt(3));
  const Bytes frame = Next();
  auto pose = Sections(frame).at(Section::kPose);
  for (int i = 0; i < 2; ++i) (void)pose.Read<double>();
  for (int i = 0; i < 3 + 4 + 4; ++i) (void)pose.F32();
  EXPECT_NEAR(pose.F32(), 0.1F, 1e-6F);
  EXPECT_NEAR(pose.F32(), 0.2F, 1e-6F);
  EXPECT_NEAR(pose.F32(), 0.3F, 1e-6F);
  for (int i = 0; i < 3; ++i) (void)pose.F32();
  EXPECT_EQ(pose.F32(), 1.0F);  // OK
  EXPECT_EQ(pose.U32(), 0U);
  EXPECT_TRUE(pose.is_at_end());
}

TEST_F(ClientFrame, ATimelineIsSentWhenItChanges) {
  view_.SetTimeline({.t_s = 1.5, .duration_s = 10.0});
  Bytes frame = Next();
  EXPECT_NE(Sections(frame).at(Section::kTimeline).Text().find("\"t_s\":1.5"), std::string::npos);
  EXPECT_TRUE(Next().empty());
}

}  // namespace
}  // namespace lio
