// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs a registration method from sweep to match, without filter or motion, for the contract suite
// and the benchmarks. The frames imu and lidar are the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "lio/registration/match_diagnostics.hpp"
#include "pipeline/match_method.hpp"
#include "support/guess_cov.hpp"
#include "support/street_scene.hpp"

namespace lio::test {

struct MethodScan {
  std::vector<Eigen::Vector3f> points;
  std::vector<FeatureTag> tags;
  std::vector<Eigen::Vector3f> to_match;
  std::vector<FeatureTag> to_match_tags;
};

inline Options MethodOptions(MatchMethod method) {
  Options options;
  options.pipeline.method = method;
  options.pipeline.use_imu = false;
  options.rig.lidar.min_range_m = 1.0;
  return options;
}

class MethodBench {
 public:
  explicit MethodBench(const Options& options)
      : reducer_(MakeReducer(options, SpinningLidar::Hdl32e().elevation_rad)),
        matcher_(MakeMatcher(options)) {}
  explicit MethodBench(MatchMethod method) : MethodBench(MethodOptions(method)) {}

  // The sensor did not move during the sweep.
  MethodScan Reduce(const Sweep& sweep) {
    const ReducedScan reduced = reducer_->Reduce(sweep);
    MethodScan scan;
    for (const ScanPoint& point : reduced.points) scan.points.push_back(point.position);
    scan.tags = reduced.tags;
    for (const std::uint32_t i : reduced.to_match) {
      scan.to_match.push_back(scan.points[i]);
      if (!scan.tags.empty()) scan.to_match_tags.push_back(scan.tags[i]);
    }
    return scan;
  }
  void Insert(const MethodScan& scan, const Pose& T_map_imu) {
    matcher_->Insert({scan.points, scan.tags}, T_map_imu);
  }
  static MatchInput InputFor(const MethodScan& scan, const Pose& guess, const Matrix6& cov) {
    const double shift_std_m = std::sqrt(cov.topLeftCorner<3, 3>().diagonal().maxCoeff());
    return {scan.to_match, guess, cov, false, scan.to_match_tags, scan.points, shift_std_m};
  }
  MatchResult Match(const MethodScan& scan, const Pose& guess, const Matrix6& cov) {
    return matcher_->Match(InputFor(scan, guess, cov));
  }
  ScanMatcher& matcher() { return *matcher_; }
  const MatchDiagnostics& diagnostics() const {
    return dynamic_cast<const MatchDiagnostics&>(*matcher_);
  }

 private:
  std::unique_ptr<SweepReducer> reducer_;
  std::unique_ptr<ScanMatcher> matcher_;
};

// Returns the same scan seen from another pose: p = T_old_new^-1 p_old for every point.
inline MethodScan Moved(MethodScan scan, const Pose& T_old_new) {
  const Pose T_new_old = T_old_new.Inverse();
  for (auto* points : {&scan.points, &scan.to_match}) {
    for (Eigen::Vector3f& point : *points) point = (T_new_old * point.cast<double>()).cast<float>();
  }
  return scan;
}

}  // namespace lio::test
