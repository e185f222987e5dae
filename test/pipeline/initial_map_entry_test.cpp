// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/initial_map_entry.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lio/base/voxel_key.hpp"
#include "lio/base/voxel_set.hpp"
#include "lio/registration/gicp_matcher.hpp"
#include "lio/registration/ndt_matcher.hpp"
#include "lio/relocalization/parameters.hpp"
#include "support/scene.hpp"

namespace lio {
namespace {

constexpr int kMaxScans = 60;

Pose AboveGroundAt(double x, double yaw_rad = 0.0) {
  return {ExpSo3(Vector3(0, 0, yaw_rad)), Vector3(x, 0, 1.0)};
}

std::vector<Eigen::Vector3f> Seen(const Pose& T_world_imu, unsigned seed) {
  std::mt19937_64 random(seed);
  test::Lidar lidar = test::TestLidar();
  lidar.num_azimuths = 600;
  return test::CastStill(test::Street(), lidar, T_world_imu, random);
}

// The street as scans every metre show it, in axes that are turned and moved against the world.
const Pose kInitialFromWorld{ExpSo3(Vector3(0, 0, 0.7)), Vector3(-20, 35, 4)};

// Like map.pcd, it has one point per voxel of 0.2 m. It reaches up to `to_m` along the street.
InitialMap StreetMap(int to_m = 140) {
  constexpr double kVoxel_m = 0.2;
  InitialMap map;
  VoxelSet taken;
  for (int i = 0; i < to_m; ++i) {
    const Pose T_world_imu = AboveGroundAt(i);
    for (const Eigen::Vector3f& point : Seen(T_world_imu, 100 + static_cast<unsigned>(i))) {
      const Vector3 point_world = T_world_imu * point.cast<double>();
      const auto [x, y, z] = VoxelOf(point_world / kVoxel_m);
      if (!taken.Insert(PackVoxel(x, y, z))) continue;
      map.points.emplace_back((kInitialFromWorld * point_world).cast<float>());
    }
  }
  return map;
}

// Drives on from `x_m` by half a metre a scan, with a new map whose origin is the first pose.
std::optional<FoundPlace> Seek(InitialMapEntry& entry, double x_m, int* num_scans = nullptr) {
  const Pose T_world_map = AboveGroundAt(x_m, 0.3);
  for (int i = 0; i < kMaxScans; ++i) {
    if (num_scans != nullptr) *num_scans = i + 1;
    const Pose T_world_imu = AboveGroundAt(x_m + 0.5 * i, 0.3);
    const auto points = Seen(T_world_imu, static_cast<unsigned>(i));
    MatchResult match;
    match.status = MatchStatus::kConverged;
    match.T_map_imu = T_world_map.Inverse() * T_world_imu;
    match.num_matched = static_cast<int>(0.98 * static_cast<double>(points.size()));
    match.num_in_map = static_cast<int>(points.size());
    MatchBudget budget(kRelocalization.max_matches_per_scan);
    if (const auto found = entry.Seek({points, match}, points, Pose{}, budget)) return found;
    EXPECT_LE(budget.num_taken(), 2);
  }
  return std::nullopt;
}

TEST(InitialMapEntry, FindsTheNewMapInTheInitialOne) {
  InitialMapEntry entry(StreetMap(), std::make_unique<NdtMatcher>(NdtOptions{}));
  for (const double x_m : {30.0, 95.0}) {
    int num_scans = 0;
    const auto found = Seek(entry, x_m, &num_scans);
    ASSERT_TRUE(found) << x_m;
    const Pose off = (kInitialFromWorld * AboveGroundAt(x_m, 0.3)).Inverse() * found->T_initial_map;
    EXPECT_LT(off.translation.norm(), 0.1) << x_m << " m, after " << num_scans << " scans";
    EXPECT_LT(LogSo3(off.rotation).norm(), 0.01);
    std::unique_ptr<ScanMatcher> matcher = std::make_unique<NdtMatcher>(NdtOptions{});
    entry.Leave(matcher);  // and again
  }
}

TEST(InitialMapEntry, GuessOfAnotherPlaceFindsNothing) {
  InitialMap map = StreetMap();
  map.guess = {(kInitialFromWorld * AboveGroundAt(95.0)).translation, 0.7};
  InitialMapEntry entry(map, std::make_unique<NdtMatcher>(NdtOptions{}));
  EXPECT_FALSE(Seek(entry, 30.0));
}

TEST(InitialMapEntry, MatchersChangePlacesAndBack) {
  InitialMapEntry entry(StreetMap(5), std::make_unique<NdtMatcher>(NdtOptions{}));
  std::unique_ptr<ScanMatcher> matcher = std::make_unique<NdtMatcher>(NdtOptions{});
  const ScanMatcher* own = matcher.get();
  EXPECT_FALSE(entry.is_inside());
  entry.Leave(matcher);
  EXPECT_EQ(matcher.get(), own) << "it was not inside";
  entry.Enter(matcher);
  EXPECT_TRUE(entry.is_inside());
  EXPECT_GT(matcher->map_size().num_cells, 1000u);
  entry.Leave(matcher);
  EXPECT_EQ(matcher.get(), own);
}

TEST(InitialMapEntry, RefusesAMethodThatHasNoUseForPoints) {
  EXPECT_THROW(InitialMapEntry(StreetMap(5), std::make_unique<GicpMatcher>(GicpOptions{})),
               std::invalid_argument);
}

}  // namespace
}  // namespace lio
