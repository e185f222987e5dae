// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/view_state.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "view/view_fixture.hpp"

namespace lio {
namespace {

using test::CloudOf;
using test::NavAt;
using test::StatusOfRun;
using test::UtimeAt;

TEST(ViewState, PathHasTheScansPosesAndPoseTheNewestOne) {
  ViewState view;
  for (int i = 0; i < 5; ++i) view.OnOdometry(NavAt(i), UtimeAt(i));
  view.OnOdometry(NavAt(4.5, OdometrySource::kImuPropagated), UtimeAt(4.5));
  ASSERT_EQ(view.path().rows().size(), 5U);
  EXPECT_EQ(view.path().rows()[3].x_m, 3.0F);
  EXPECT_EQ(view.path().rows()[3].status, 1.0F);
  EXPECT_EQ(view.pose().value.nav.T_map_imu.translation.x(), 4.5);
  EXPECT_NEAR(view.RateHz(ViewChannel::kOdometry, UtimeAt(4)), 1.0, 1e-9);
}

TEST(ViewState, AScansPoseDoesNotPutTheNewestOneBack) {
  ViewState view;
  view.OnOdometry(NavAt(1.2, OdometrySource::kImuPropagated), UtimeAt(1.2));
  view.OnOdometry(NavAt(1.1), UtimeAt(1.3));
  EXPECT_EQ(view.pose().value.nav.T_map_imu.translation.x(), 1.2);
  EXPECT_EQ(view.path().rows().size(), 1U);
}

TEST(ViewState, StandingStillMakesThePathNoLonger) {
  ViewState view;
  for (int i = 0; i < 100; ++i) view.OnOdometry(NavAt(1e-4 * i), UtimeAt(i));
  EXPECT_EQ(view.path().rows().size(), 1U);
}

TEST(ViewState, TheMapHasAPointAVoxelAndTheScanAllPoints) {
  ViewState view;
  view.OnCloud(CloudOf(1, 100), UtimeAt(0), false);
  view.OnCloud(CloudOf(2, 100), UtimeAt(1), false);
  EXPECT_EQ(view.map().points_map().size(), 100U);
  EXPECT_EQ(view.scan().value.size(), 100U);
  EXPECT_EQ(view.scan().number, 2U);
  view.OnCloud(CloudOf(3, 100, 50.0F), UtimeAt(2), false);
  EXPECT_EQ(view.map().points_map().size(), 150U);
}

TEST(ViewState, ChunksOfASweepAreOneScan) {
  ViewState view;
  for (std::int16_t i = 0; i < 3; ++i) {
    ScanChunk chunk = CloudOf(7, 10, 10.0F * i);
    chunk.chunk_index = i;
    chunk.chunk_count = 3;
    view.OnCloud(chunk, UtimeAt(0), true);
  }
  EXPECT_EQ(view.scan().number, 1U);
  EXPECT_EQ(view.scan().value.size(), 30U);
  // The thinned cloud only adds to the map where the full ones come.
  view.OnCloud(CloudOf(8, 5), UtimeAt(0.1), false);
  EXPECT_EQ(view.scan().number, 1U);
  EXPECT_EQ(view.RateHz(ViewChannel::kStatus, UtimeAt(0)), 0.0);
}

TEST(ViewState, ASweepThatLacksItsLastChunkIsShownWithTheNextOne) {
  ViewState view;
  ScanChunk chunk = CloudOf(7, 10);
  chunk.chunk_count = 3;
  view.OnCloud(chunk, UtimeAt(0), true);
  EXPECT_EQ(view.scan().number, 0U);
  chunk.scan_seq = 8;
  view.OnCloud(chunk, UtimeAt(0.1), true);
  EXPECT_EQ(view.scan().number, 1U);
}

TEST(ViewState, ManyPointsMakeVoxelsWiderAndAGeneration) {
  ViewState view({.max_map_points = 1000});
  const auto generation = view.map_generation();
  view.OnCloud(CloudOf(1, 1200), UtimeAt(0), false);
  EXPECT_LE(view.map().points_map().size(), 1000U);
  EXPECT_GT(view.map_generation(), generation);
}

TEST(ViewState, PointsThatAreNoPlacesAreLeftOut) {
  ViewState view;
  ScanChunk chunk = CloudOf(1, 3);
  chunk.points[0].x_m = std::numeric_limits<float>::quiet_NaN();
  chunk.points[1].y_m = 1e30F;
  view.OnCloud(chunk, UtimeAt(0), false);
  EXPECT_EQ(view.map().points_map().size(), 1U);
  EXPECT_EQ(view.scan().value.size(), 1U);
}

TEST(ViewState, APoseOutOfThisWorldIsRefused) {
  ViewState view;
  NavOutput nav = NavAt(0);
  nav.T_map_imu.translation.x() = 1e9;
  view.OnOdometry(nav, UtimeAt(0));
  EXPECT_EQ(view.pose().number, 0U);
  EXPECT_EQ(view.num_refused(), 1);
}

class NewRun : public ::testing::Test {
 protected:
  NewRun() {
    view_.OnStatus(StatusOfRun(5), UtimeAt(0));
    view_.OnCloud(CloudOf(1, 10), UtimeAt(0), false);
    view_.OnOdometry(NavAt(10), UtimeAt(0));
  }
  ViewState view_;
};

TEST_F(NewRun, ARestartedDaemonBeginsAnew) {
  view_.OnStatus(StatusOfRun(5), UtimeAt(1));
  EXPECT_EQ(view_.path().rows().size(), 1U);
  view_.OnStatus(StatusOfRun(6), UtimeAt(2));
  EXPECT_TRUE(view_.path().rows().empty());
  EXPECT_TRUE(view_.map().points_map().empty());
  EXPECT_EQ(view_.num_runs(), 1);
}

TEST_F(NewRun, ARestartedEstimatorBeginsAnew) {
  view_.OnStatus(StatusOfRun(5, 1), UtimeAt(1));
  EXPECT_TRUE(view_.path().rows().empty());
}

TEST_F(NewRun, StampsThatGoFarBackBeginAnew) {
  view_.OnOdometry(NavAt(9.5), UtimeAt(1));
  EXPECT_EQ(view_.num_runs(), 0);
  view_.OnOdometry(NavAt(1), UtimeAt(1));
  EXPECT_EQ(view_.num_runs(), 1);
  ASSERT_EQ(view_.path().rows().size(), 1U);
  EXPECT_EQ(view_.path().rows()[0].x_m, 1.0F);
}

TEST_F(NewRun, AMatchThatLagsBehindTheSamplesBeginsNothing) {
  for (int i = 0; i < 5; ++i) {
    view_.OnOdometry(NavAt(12 + i, OdometrySource::kImuPropagated), UtimeAt(i));
    view_.OnOdometry(NavAt(10.1 + i), UtimeAt(i));
  }
  EXPECT_EQ(view_.num_runs(), 0);
  EXPECT_EQ(view_.path().rows().size(), 6U);
  EXPECT_EQ(view_.pose().value.nav.T_map_imu.translation.x(), 16.0);
}

TEST(ViewState, StatesHaveVelocityBiasesAndNis) {
  ViewState view;
  FilterReport report;
  report.nav = NavAt(1);
  report.nav.v_world_imu_mps = {1, 2, 3};
  report.gyro_bias_radps = {4, 5, 6};
  report.accel_bias_mps2 = {7, 8, 9};
  report.nis = 10;
  report.nis_dof = 6;
  view.OnFilterState(report);
  ASSERT_EQ(view.states().rows().size(), 1U);
  for (std::size_t i = 0; i < StateRow::kNumValues; ++i) {
    EXPECT_EQ(view.states().rows()[0].values[i], static_cast<float>(i + 1));
  }
  view.OnFilterState(report);  // the same instant again
  EXPECT_EQ(view.states().rows().size(), 1U);
}

TEST(EllipsoidOf, HasTheStandardDeviationsAlongItsAxes) {
  NavOutput nav = NavAt(0);  // variances 0.01, 0.04, 0.09 along x, y, z of world
  // Map is turned by 90 degrees about z against world: x of world is y of map.
  nav.T_map_imu.rotation = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ()));
  const PositionEllipsoid ellipsoid = EllipsoidOf(nav);
  EXPECT_NEAR(ellipsoid.std_m.x(), 0.1, 1e-9);
  EXPECT_NEAR(ellipsoid.std_m.z(), 0.3, 1e-9);
  EXPECT_NEAR(std::abs((ellipsoid.axes * Vector3::UnitX()).y()), 1.0, 1e-9);
  EXPECT_NEAR(std::abs((ellipsoid.axes * Vector3::UnitZ()).z()), 1.0, 1e-9);
}

TEST(EllipsoidOf, ACovarianceThatIsNoneGivesNoImaginaryAxis) {
  NavOutput nav = NavAt(0);
  nav.pose_cov = -Matrix6::Identity();
  EXPECT_EQ(EllipsoidOf(nav).std_m, Vector3::Zero());
}

}  // namespace
}  // namespace lio
