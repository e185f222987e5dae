// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Direct matching of a scan against a submap of keyframes, plane to plane (generalised ICP): every
// point against its nearest neighbour e = q - T p, along the direction b that both surfaces' shapes
// hold best,
//   cost = sum of rho((b . e)^2 / s) / 2,  s = b' (C_q + R C_p R') b + k a^4 + reach^2,
// C a surface's thickness along its normal and 1 m^2 across, rho Geman-McClure's, a the length of e
// across b, k how much the surfaces may bend, from their thickness and width: in a vault neighbours
// half a metre apart differ by centimetres, always to the same side. b bisects the two normals: the
// least eigenvector of C_q + R C_p R'. `reach` is what the guess may be off and shrinks to nothing.
// Shapes are computed once, when a scan comes, and kept with its points in the keyframes. Points of
// no known surface (single rings, edges, bushes) are held to the surface of their neighbour, which
// shows a motion that is not there by centimetres: they count only where surfaces leave a direction
// open and the shift is not known better.
//
// Which scans become keyframes depends on how far the vehicle has moved against how open the place
// is. Insert() decides; what Match() says about new content takes it into account.
// Sources: Segal, Haehnel, Thrun, "Generalized-ICP", RSS 2009; Chen et al., "Direct LiDAR
// Odometry", RA-L 2022, for keyframes and submap.
// Differences: what the other two eigenvectors hold is left out, for it holds a point to its
// neighbour's place on the surface, which is by chance; the nearest neighbours come from one voxel
// index of all keyframes, in which a submap is a choice, where DLO builds a k-d tree for each
// submap; single scan rings count as no surface; keyframes are bounded in number.
#pragma once

#include <memory>
#include <vector>

#include "lio/map/keyframe_map.hpp"
#include "lio/registration/gicp_options.hpp"
#include "lio/registration/match_summary.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/registration/search_radius.hpp"

namespace lio {

class ScanNormals;

class GicpMatcher final : public ScanMatcher {
 public:
  explicit GicpMatcher(const GicpOptions& options);
  ~GicpMatcher() override;

  MatchResult Match(const MatchInput& input) override;
  void Insert(const ScanView& scan, const Pose& T_map_imu) override;
  void Clear() override;
  MapSize map_size() const override;
  double FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const override;

  std::size_t num_keyframes() const { return map_.num_keyframes(); }
  double openness_m() const { return openness_m_; }

 private:
  // A point and its neighbour; map axes.
  struct Pair {
    std::int32_t point = 0;
    std::int32_t target = 0;
    Eigen::Vector3f offset;  // e at the pose of pairing
  };
  struct Term {
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();  // b
    float distance = 0.f;                                 // along it [m]
    float distance_sq = 0.f;                              // in its variance
    RobustKernel kernel;
    float weight = 0.f;    // 1 / m^2; 0: no pair
    float tilt_var = 0.f;  // of b toward either side [rad^2]
  };

  // Pairs every point anew, or moves the pairs along where the pose has hardly changed.
  void Associate(const Pose& T_map_imu, const SearchRadius& radius);
  void MovePairs(const Pose& T_map_imu);
  Term TermOf(const Pair& pair, const Eigen::Matrix3f& rotation, float reach_var) const;
  // Of surfaces, and of all else where these do not hold the pose and the guess does not either.
  MatchSums Linearize(const Pose& T_map_imu, const SearchRadius& radius, PoseScores* scores);
  MatchSums SumTerms(const Pose& T_map_imu, const SearchRadius& radius, PoseScores* scores) const;
  bool IsKeyframe(const Pose& T_map_imu) const;
  double NewContentShare(const MatchInput& input, const Pose& T_map_imu) const;
  void Finish(const MatchInput& input, const Pose& T_map_imu, MatchResult& result);
  void UpdateOpenness(std::span<const Eigen::Vector3f> points_imu);

  GicpOptions options_;
  KeyframeMap map_;
  std::unique_ptr<ScanNormals> shapes_;
  std::vector<PointWithNormal> source_;  // the scan's points that are matched
  std::vector<std::int32_t> near_;       // each one's last neighbour; kUnknown, kNowhere
  std::vector<Pair> pairs_;              // of the current iteration, in the points' order
  Pose paired_at_;                       // where the pairs' offsets hold
  Pose sought_at_;                       // where their neighbours were sought
  bool is_far_off_ = false;              // the guess may be
  bool has_shapeless_ = false;           // source_ has points of no known shape, ...
  bool uses_shapeless_ = false;          // ... which count
  PoseScores scores_;
  double openness_m_ = 0.0;  // smoothed median range; 0: no scan yet
};

}  // namespace lio
