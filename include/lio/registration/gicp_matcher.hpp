// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Matches a scan directly against a submap of keyframes, plane to plane (generalized ICP). Each
// point p is paired with its nearest neighbour q; e = q - T p is their offset, b the direction
// along which both surfaces constrain it best, and the cost is
//   sum of rho((b . e)^2 / s) / 2,  s = b' (C_q + R C_p R') b + k a^4 + radius^2.
// C is a surface's covariance: its thickness along the normal and 1 m^2 across; b is the least
// eigenvector of C_q + R C_p R' and bisects the two normals. rho is Geman-McClure's kernel. a is
// the length of e across b, and k the bend of both surfaces, from their thickness and width: on a
// vault neighbours half a metre apart differ by centimetres, always to the same side. `radius` is
// the correspondence radius (search_radius.hpp), which shrinks to zero.
//
// Normals are computed once, when a scan comes, and kept with its points in the keyframes. Points
// whose surroundings are rank-deficient (single rings, edges, bushes) have none; they take the
// normal of their neighbour, which biases the motion by centimetres, so they count only where
// points with normals leave a direction degenerate and the translation is not known better.
//
// A scan becomes a keyframe when the vehicle has moved far enough against how open the place is.
// Insert() decides; new_content_share of Match() takes it into account.
// Sources: Segal, Haehnel, Thrun, "Generalized-ICP", RSS 2009; Chen et al., "Direct LiDAR
// Odometry", RA-L 2022, for keyframes and submap.
// Differences: the other two eigenvectors of the pair's covariance have no rows in the cost, since
// they would pull a point to its neighbour's place on the surface, which is by chance; nearest
// neighbours come from one voxel map of all keyframes, in which a submap is a choice, where DLO
// builds a k-d tree for each submap; single scan rings have no normal; keyframes are bounded in
// number.
#pragma once

#include <memory>
#include <vector>

#include "lio/map/keyframe_map.hpp"
#include "lio/registration/gicp_options.hpp"
#include "lio/registration/match_diagnostics.hpp"
#include "lio/registration/match_summary.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/registration/search_radius.hpp"

namespace lio {

class ScanNormals;

class GicpMatcher final : public ScanMatcher, public MatchDiagnostics {
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
  // Holds a point of the scan and its neighbour on the map.
  struct Pair {
    std::int32_t point = 0;
    std::int32_t target = 0;
    Eigen::Vector3f offset;  // e at the pose of pairing [m], map axes
  };
  struct Term {
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();  // b
    float distance = 0.f;                                 // b . e [m]
    float distance_sq = 0.f;                              // (b . e)^2 / s
    RobustKernel kernel;
    float weight = 0.f;    // 1 / m^2; 0: the pair does not count
    float tilt_var = 0.f;  // variance of b's angle toward either tangent [rad^2]
  };

  // Finds a neighbour for every point, or keeps the pairs where the pose has hardly changed.
  void Associate(const Pose& T_map_imu, const SearchRadius& radius);
  void MovePairs(const Pose& T_map_imu);
  Term TermOf(const Pair& pair, const Eigen::Matrix3f& rotation, float radius_var) const;
  // Sums the terms of points with normals, and those of all points where the former leave a
  // direction degenerate and rank-deficient points were taken in.
  MatchSums Linearize(const Pose& T_map_imu, const SearchRadius& radius, MatchScores* scores);
  MatchSums SumTerms(const Pose& T_map_imu, const SearchRadius& radius, MatchScores* scores) const;
  bool IsKeyframe(const Pose& T_map_imu) const;
  double NewContentShare(const MatchInput& input, const Pose& T_map_imu) const;
  void Finish(const MatchInput& input, const Pose& T_map_imu, MatchResult& result);
  void UpdateOpenness(std::span<const Eigen::Vector3f> points_imu);

  GicpOptions options_;
  KeyframeMap map_;
  std::unique_ptr<ScanNormals> normals_;
  std::vector<PointWithNormal> source_;  // the scan's points that are matched
  std::vector<std::int32_t> near_;       // each one's last neighbour; kUnknown, kNowhere
  std::vector<Pair> pairs_;              // in the current iteration, in the points' order
  Pose paired_at_;                       // the pairs' offsets are for this pose
  Pose sought_at_;                       // the neighbours were sought at this pose
  bool is_far_off_ = false;              // MatchInput::is_far_off
  bool has_rank_deficient_ = false;      // source_ includes points without a normal
  bool uses_rank_deficient_ = false;     // they count in the present sums
  MatchScores scores_;
  Pose T_imu_lidar_;         // the matched scan's
  double openness_m_ = 0.0;  // smoothed median range; 0: no scan yet
};

}  // namespace lio
