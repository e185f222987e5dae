// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/loam_reducer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "support/street_scene.hpp"

namespace lio {
namespace {

Sweep RayCastStreet() {
  test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
  lidar.num_columns = 1200;
  return CastTurn(test::StreetScene(), lidar, test::SensorAt(0, 0)).sweep;
}

TEST(LoamReducer, TagsSayWhatEachPointIs) {
  const Sweep sweep = RayCastStreet();
  LoamReducer reducer({}, {}, {}, {});
  const ReducedScan scan = reducer.Reduce(sweep);
  ASSERT_EQ(scan.tags.size(), scan.points.size());
  ASSERT_NE(scan.features, nullptr);
  std::array<std::size_t, 4> counts{};
  for (const FeatureTag& tag : scan.tags) ++counts[static_cast<std::size_t>(tag.kind)];
  EXPECT_EQ(counts[0], scan.features->sharp.size());
  EXPECT_EQ(counts[0] + counts[1], scan.features->less_sharp.size());
  EXPECT_GT(counts[2], 300u);
  EXPECT_GT(counts[3], 2000u);
  EXPECT_LE(counts[2] + counts[3], scan.features->flat.size() + scan.features->less_flat.size());
}

TEST(LoamReducer, MatchesAboutAsManyAsAskedForEdgesFirst) {
  ReduceOptions options;
  options.match_points = 1500;
  LoamReducer reducer({}, options, {}, {});
  const ReducedScan scan = reducer.Reduce(RayCastStreet());
  EXPECT_NEAR(static_cast<double>(scan.to_match.size()), 1500.0, 20.0);
  const auto num_edges = static_cast<std::size_t>(
      std::count_if(scan.to_match.begin(), scan.to_match.end(),
                    [&](std::uint32_t i) { return scan.tags[i].IsEdge(); }));
  EXPECT_EQ(num_edges, std::min<std::size_t>(scan.features->less_sharp.size(), 750));
  EXPECT_EQ(std::set(scan.to_match.begin(), scan.to_match.end()).size(), scan.to_match.size());
}

TEST(LoamReducer, ThinningAdaptsToTheTarget) {
  const Sweep sweep = RayCastStreet();
  ReduceOptions options;
  options.target_points = 2000;
  LoamReducer reducer({}, options, {}, {});
  std::size_t num_surfaces = 0;
  for (int i = 0; i < 10; ++i) {
    const ReducedScan scan = reducer.Reduce(sweep);
    num_surfaces = scan.points.size() - scan.features->less_sharp.size();
  }
  EXPECT_NEAR(static_cast<double>(num_surfaces), 2000.0, 300.0);
}

TEST(LoamReducer, CountsWhatIsNotFinite) {
  Sweep sweep = RayCastStreet();
  for (std::size_t i = 0; i < 10; ++i) {
    sweep.points[i * 7].y_m = std::numeric_limits<float>::infinity();
  }
  LoamReducer reducer({}, {}, {}, {});
  EXPECT_EQ(reducer.Reduce(sweep).num_nonfinite, 10);
}

TEST(LoamReducer, WithoutRingsAndBeamsNothingIsLeft) {
  Sweep sweep = RayCastStreet();
  for (LidarPoint& point : sweep.points) point.ring = 0;
  LoamReducer blind({}, {}, {}, {});
  EXPECT_TRUE(blind.Reduce(sweep).points.empty());
  EXPECT_TRUE(blind.Reduce(sweep).to_match.empty());
  LoamReducer knowing({}, {}, {}, test::SpinningLidar::Hdl32e().elevation_rad);
  const ReducedScan scan = knowing.Reduce(sweep);
  EXPECT_GT(scan.points.size(), 3000u);
  EXPECT_GT(std::max_element(scan.tags.begin(), scan.tags.end(),
                             [](auto& a, auto& b) { return a.ring < b.ring; })
                ->ring,
            20);
}

}  // namespace
}  // namespace lio
