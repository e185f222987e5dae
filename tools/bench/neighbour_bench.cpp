// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares two searches for nearest neighbours in a submap of keyframes: liod's voxel index, and
// nanoflann's k-d tree, which has to be rebuilt whenever the submap changes.
#include <benchmark/benchmark.h>

#include <nanoflann.hpp>
#include <random>

#include "lio/map/keyframe_map.hpp"
#include "support/method_bench.hpp"

namespace lio {
namespace {

constexpr int kNumKeyframes = 20;

struct Submap {
  std::vector<std::vector<PointWithNormal>> keyframes;
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3f> points;   // all of them, map frame
  std::vector<Eigen::Vector3f> queries;  // a scan near its place

  Submap() {
    const test::RayScene scene = test::StreetScene();
    test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
    lidar.range_std_m = 0.02;
    test::MethodBench bench(MatchMethod::kGicp);
    for (int k = 0; k <= kNumKeyframes; ++k) {
      const Pose pose = test::SensorAt(-10.0 + k, 0.2 * std::sin(k), 0.03 * std::sin(2.0 * k));
      const auto scan =
          bench.Reduce(CastTurn(scene, lidar, pose, static_cast<std::uint32_t>(k)).sweep);
      if (k == kNumKeyframes) {
        for (const Eigen::Vector3f& p : scan.to_match) {
          queries.push_back((pose * p.cast<double>()).cast<float>() +
                            Eigen::Vector3f(0.03f, -0.02f, 0.01f));
        }
        return;
      }
      std::vector<PointWithNormal> shaped;
      for (const Eigen::Vector3f& p : scan.points) {
        PointWithNormal point;
        point.position = p;
        point.thickness_var = 1e-3f;
        shaped.push_back(point);
        points.push_back((pose * p.cast<double>()).cast<float>());
      }
      keyframes.push_back(std::move(shaped));
      poses.push_back(pose);
    }
  }
};

const Submap& TheSubmap() {
  static const Submap kSubmap;  // made once for all benchmarks
  return kSubmap;
}

KeyframeMap MakeIndex() {
  KeyframeMap map(KeyframeMapOptions{});
  for (std::size_t k = 0; k < TheSubmap().keyframes.size(); ++k) {
    map.Add(TheSubmap().keyframes[k], TheSubmap().poses[k]);
  }
  map.ChooseSubmap({0, 0, 0});
  return map;
}

struct Cloud {
  const std::vector<Eigen::Vector3f>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud,
                                                 3, std::uint32_t>;

void BM_VoxelIndexSearch(benchmark::State& state) {
  const KeyframeMap map = MakeIndex();
  for (auto _ : state) {
    for (const Eigen::Vector3f& query : TheSubmap().queries) {
      benchmark::DoNotOptimize(map.FindNearest(query.cast<double>(), 0.7));
    }
  }
  state.counters["points"] = static_cast<double>(map.num_points());
  state.counters["queries"] = static_cast<double>(TheSubmap().queries.size());
}

void BM_NanoflannSearch(benchmark::State& state) {
  const Cloud cloud{TheSubmap().points};
  Tree tree(3, cloud);
  tree.buildIndex();
  for (auto _ : state) {
    for (const Eigen::Vector3f& query : TheSubmap().queries) {
      std::uint32_t index = 0;
      float distance_sq = 0.f;
      benchmark::DoNotOptimize(tree.knnSearch(query.data(), 1, &index, &distance_sq));
    }
  }
}

// A new keyframe adds its points to the index, but rebuilds the tree of the whole submap.
void BM_VoxelIndexAddKeyframe(benchmark::State& state) {
  KeyframeMap map = MakeIndex();
  for (auto _ : state) map.Add(TheSubmap().keyframes[5], TheSubmap().poses[5]);
}

void BM_NanoflannBuild(benchmark::State& state) {
  const Cloud cloud{TheSubmap().points};
  for (auto _ : state) {
    Tree tree(3, cloud);
    tree.buildIndex();
    benchmark::DoNotOptimize(tree.size(tree));
  }
}

BENCHMARK(BM_VoxelIndexSearch)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_NanoflannSearch)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_VoxelIndexAddKeyframe)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_NanoflannBuild)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lio
