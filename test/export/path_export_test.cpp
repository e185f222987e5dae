// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/recorded_log.hpp"
#include "lio/export/export_log.hpp"
#include "lio/io/initial_map_file.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

TEST(PathExport, TumHasThePosesInWorld) {
  const test::TempDir folder;
  const auto file = folder.path() / "path.tum";
  const ExportCounts counts = ExportTum(test::RecordedLog(folder), file, {});
  EXPECT_EQ(counts.num_messages, test::kNumScans);
  const Trajectory path = ReadTrajectory(file);
  ASSERT_EQ(path.poses.size(), static_cast<std::size_t>(test::kNumScans));
  EXPECT_EQ(path.poses[10].stamp, test::NavOf(10).stamp);
  EXPECT_NEAR(path.poses[10].pose.translation.y(), 5.0, 1e-9);
}

TEST(PathExport, PlyHasAPointAVoxelAndOpensAsAMap) {
  const test::TempDir folder;
  const auto file = folder.path() / "map.ply";
  const ExportCounts counts = ExportPly(test::RecordedLog(folder), file, {});
  constexpr int kFinitePoints = 19;
  EXPECT_EQ(counts.num_points, test::kNumScans * kFinitePoints);
  EXPECT_EQ(LoadMapPoints(file).size(), static_cast<std::size_t>(counts.num_points));
}

}  // namespace
}  // namespace lio
