// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The drive that tests of all registration methods make their map from.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/method_bench.hpp"

namespace lio::test {

inline SpinningLidar Lidar(double range_std_m = 0.0, double start_azimuth_rad = 0.0) {
  SpinningLidar lidar = SpinningLidar::Hdl32e();
  lidar.num_columns = 1200;
  lidar.range_std_m = range_std_m;
  lidar.start_azimuth_rad = start_azimuth_rad;
  return lidar;
}

// The map is made from a drive of 4 m with a little of every motion.
inline constexpr int kNumMapScans = 11;
inline Pose DrivePose(int i) {
  return SensorAt(-2.0 + 0.4 * i, 0.3 * std::sin(i), 0.02 * std::sin(2.0 * i),
                  0.01 * std::sin(1.3 * i), 0.01 * std::cos(1.7 * i));
}

inline std::vector<Sweep> DriveSweeps(const RayScene& scene, double range_std_m) {
  std::vector<Sweep> sweeps;
  for (int i = 0; i < kNumMapScans; ++i) {
    const auto seed = static_cast<std::uint32_t>(100 + i);
    sweeps.push_back(CastTurn(scene, Lidar(range_std_m, 0.013 * i), DrivePose(i), seed).sweep);
  }
  return sweeps;
}

// Returns the sweeps of the drive through StreetScene(street); they are cast once a process, since
// casting them takes most of a test's time under the sanitizers.
inline const std::vector<Sweep>& StreetSweeps(double range_std_m, unsigned street = 1) {
  static std::map<std::pair<double, unsigned>, std::vector<Sweep>> cast;
  std::vector<Sweep>& sweeps = cast[{range_std_m, street}];
  if (sweeps.empty()) sweeps = DriveSweeps(StreetScene(street), range_std_m);
  return sweeps;
}

inline void GrowMap(MethodBench& bench, const std::vector<Sweep>& sweeps) {
  for (int i = 0; i < kNumMapScans; ++i) {
    bench.Insert(bench.Reduce(sweeps[static_cast<std::size_t>(i)]), DrivePose(i));
  }
}

// The pose lies within the map of the drive.
inline const Pose kTruth = SensorAt(0.17, 0.21, 0.05, 0.013, -0.007);

inline std::string NameOfMethod(const testing::TestParamInfo<MatchMethod>& info) {
  constexpr std::array kNames{"Ndt", "Loam", "Gicp"};
  return kNames.at(static_cast<std::size_t>(info.param));
}

}  // namespace lio::test
