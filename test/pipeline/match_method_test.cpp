// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/match_method.hpp"

#include <gtest/gtest.h>

#include "lio/registration/gicp_matcher.hpp"
#include "lio/registration/loam_matcher.hpp"
#include "lio/registration/loam_scan_matcher.hpp"
#include "lio/registration/ndt_matcher.hpp"
#include "support/street_scene.hpp"

namespace lio {
namespace {

Options With(MatchMethod method, LoamTarget target = LoamTarget::kMap) {
  Options options;
  options.pipeline.method = method;
  options.loam.target = target;
  return options;
}

Sweep StreetSweep(bool has_rings) {
  test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
  lidar.num_columns = 600;
  Sweep sweep = CastTurn(test::StreetScene(), lidar, test::SensorAt(0, 0)).sweep;
  for (LidarPoint& point : sweep.points) {
    if (!has_rings) point.ring = 0;
  }
  return sweep;
}

template <class Matcher>
bool Makes(const Options& options) {
  return dynamic_cast<Matcher*>(MakeMatcher(options).get()) != nullptr;
}

TEST(MatchMethod, EachMethodHasItsMatcher) {
  EXPECT_TRUE(Makes<NdtMatcher>(With(MatchMethod::kNdt)));
  EXPECT_TRUE(Makes<GicpMatcher>(With(MatchMethod::kGicp)));
  EXPECT_TRUE(Makes<LoamMatcher>(With(MatchMethod::kLoam, LoamTarget::kMap)));
  EXPECT_TRUE(Makes<LoamScanMatcher>(With(MatchMethod::kLoam, LoamTarget::kScan)));
}

TEST(MatchMethod, OnlyLoamTellsPointsApart) {
  const Sweep sweep = StreetSweep(true);
  for (const MatchMethod method : {MatchMethod::kNdt, MatchMethod::kGicp}) {
    const ReducedScan scan = MakeReducer(With(method), {})->Reduce(sweep);
    EXPECT_GT(scan.points.size(), 1000u);
    EXPECT_TRUE(scan.tags.empty());
    EXPECT_EQ(scan.features, nullptr);
  }
  const ReducedScan scan = MakeReducer(With(MatchMethod::kLoam), {})->Reduce(sweep);
  EXPECT_EQ(scan.tags.size(), scan.points.size());
  EXPECT_NE(scan.features, nullptr);
}

TEST(MatchMethod, OnlyLoamNeedsRingsAndRebuildsThemByTheBeams) {
  const Sweep sweep = StreetSweep(false);
  const std::vector<double> beams = test::SpinningLidar::Hdl32e().elevation_rad;
  EXPECT_TRUE(MakeReducer(With(MatchMethod::kLoam), {})->Reduce(sweep).points.empty());
  EXPECT_GT(MakeReducer(With(MatchMethod::kLoam), beams)->Reduce(sweep).points.size(), 1000u);
  EXPECT_GT(MakeReducer(With(MatchMethod::kNdt), {})->Reduce(sweep).points.size(), 1000u);
}

TEST(MatchMethod, TheRigsRangeHoldsForEveryMethod) {
  const Sweep sweep = StreetSweep(true);
  for (const MatchMethod method : {MatchMethod::kNdt, MatchMethod::kGicp, MatchMethod::kLoam}) {
    Options options = With(method);
    options.rig.lidar.min_range_m = 15.0;
    const ReducedScan scan = MakeReducer(options, {})->Reduce(sweep);
    ASSERT_GT(scan.points.size(), 100u);
    for (const ScanPoint& point : scan.points) {
      ASSERT_GE(point.position.norm(), 15.0f);
    }
  }
}

}  // namespace
}  // namespace lio
