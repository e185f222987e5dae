// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scan-to-map registration: one interface, several backends. A matcher owns its map. The pose it
// measures is that of the imu in the map's frame, at the sweep's middle; points come in the imu
// frame at that instant, already deskewed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/match_status.hpp"
#include "lio/scan/feature_tag.hpp"

namespace lio {

// Points of a scan and, where a method tells them apart, what each stands for.
struct ScanView {
  std::span<const Eigen::Vector3f> points_imu;
  std::span<const FeatureTag> tags = {};  // of each point; empty where the method needs none
  Vector3 sensor_imu = Vector3::Zero();   // where the lidar stands
};

struct TurnRate {
  Vector3 w_imu_radps = Vector3::Zero();
  Matrix3 cov = Matrix3::Zero();
};

struct MatchInput {
  std::span<const Eigen::Vector3f> points_imu;
  Pose T_map_imu_guess;
  // Right error of the guess, [translation; rotation]: sets how far correspondences are sought. It
  // is not a prior: it stays out of the cost.
  Matrix6 guess_cov = Matrix6::Zero();
  bool is_far_off = false;                // the guess may be: take more iterations before giving up
  std::span<const FeatureTag> tags = {};  // of points_imu
  std::span<const Eigen::Vector3f> scan_points_imu = {};  // the whole scan, to see shapes in
  // Standard deviation of the guessed shift since the last scan. Things that look different from
  // each side (trunks, bushes) are left out where it is known better than they can tell.
  double shift_std_m = 1.0;
  // Of points_imu, when each was seen; only where the turn within the sweep is asked for.
  std::span<const float> from_mid_sweep_s = {};
};

struct MatchResult {
  MatchStatus status = MatchStatus::kEmptyMap;
  Pose T_map_imu;                         // under every status; the guess where nothing was matched
  Matrix6 information = Matrix6::Zero();  // Hessian of the cost at the solution, right error
  Matrix6 cov = Matrix6::Zero();          // of T_map_imu, right error; large along weak directions
  Matrix6 observable_cov = Matrix6::Zero();  // the same without the part along weak directions
  Vector6 eigenvalues = Vector6::Zero();     // of the information, rotations scaled to metres
  unsigned degenerate_mask = 0;              // bit i: eigenvalue i is not held by the scene
  int num_matched = 0;
  // Points where the map knows a surface, near or far from it; 0 where the method does not tell.
  int num_in_map = 0;
  int iterations = 0;
  double residual_rms_m = 0.0;
  // What the turn rate that the scan was deskewed by is off by; where asked for and the method can.
  std::optional<TurnRate> turn_rate_error;
  double new_content_share = 1.0;  // of the matched cells after this scan is inserted: 0..1

  bool IsUsable() const {
    return status == MatchStatus::kConverged || status == MatchStatus::kDegenerate;
  }
};

class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;

  virtual MatchResult Match(const MatchInput& input) = 0;
  virtual void Insert(const ScanView& scan, const Pose& T_map_imu) = 0;
  virtual void Clear() = 0;
  // Up in the map, to some 10 deg; before the first Insert().
  virtual void SetUp(const Vector3& /*up_map*/) {}
  // The cost at a pose with the correspondences and weights of the last Match, which had this
  // input, held; its second derivative at the solution is the information. For tests and diagnosis.
  virtual double FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const = 0;

  struct MapSize {
    std::size_t num_cells = 0;
    std::size_t memory_bytes = 0;
  };
  virtual MapSize map_size() const = 0;
};

}  // namespace lio
