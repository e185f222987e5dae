// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Matches by normal distributions: every point against the surface patch of the voxel that it falls
// into (gaussian_map.hpp).
//
// The cost is the sum over points of rho(d^2 / s), d the distance from the patch's plane and s its
// variance there, grown by the errors of this scan and of the patch's own few points:
//   s = l0 (1 + m/n (1 + a1^2/l1 + a2^2/l2)) + radius^2
// with l0 the thickness, n the patch's points, m this scan's points in the cell, a the offsets
// along the tangents of variances l; rho is Geman-McClure's kernel. `radius` is the correspondence
// radius: it begins at the guess's standard deviation and shrinks to zero, so that the same code
// converges from decimetres and ends exact.
// The covariance is the sandwich H^-1 (sum_c g_c g_c') H^-1 with scores summed per cell, since
// points of one cell share its errors (cluster_scores.hpp,
// docs/experiments/covariance_of_a_match.md).
//
// A vertical structure has two such terms, along its two level axes, with its variances there in
// place of s, and its points share an error that depends on the side from which they are seen:
// m times a variance is added for it, and the covariance has it once a cell. Planes alone are
// matched where the shift since the last scan is known as at rest, and where it is known to
// centimetres and the match contradicts its guess: then the things that stand have moved, as cars
// do that set off together with the vehicle.
//
// The map's voxel grid is rotated against the map's frame by a fixed odd rotation: a floor or a
// wall that lay on a voxel face would be split between two cells by its noise. Sources: Biber,
// Strasser, "The Normal Distributions Transform", IROS 2003; Magnusson, "The Three-Dimensional
// Normal-Distributions Transform", dissertation, Orebro 2009, chapter 6 (point to distribution).
// Differences: the distance is along the plane's normal alone and not Mahalanobis's, the kernel is
// not their mixture with a uniform distribution, and steps are Gauss-Newton's.
#pragma once

#include <array>
#include <optional>

#include "lio/base/parallel.hpp"
#include "lio/map/low_mean.hpp"
#include "lio/map/multi_resolution_map.hpp"
#include "lio/map/ndt_options.hpp"
#include "lio/map/place_width.hpp"
#include "lio/registration/intra_sweep_rate_estimator.hpp"
#include "lio/registration/match_diagnostics.hpp"
#include "lio/registration/match_summary.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct NdtTerm;

class NdtMatcher final : public ScanMatcher, public MatchDiagnostics {
 public:
  // Gives the same results to the last bit on any number of threads.
  explicit NdtMatcher(const NdtOptions& options, int num_threads = 1);

  MatchResult Match(const MatchInput& input) override;
  void Insert(const ScanView& scan, const Pose& T_map_imu) override;
  bool InsertKept(std::span<const Eigen::Vector3f> points_map) override;
  double FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const override;
  void Clear() override;
  void SetUp(const Vector3& up_map) override;
  MapSize map_size() const override { return {map_.num_cells(), map_.memory_bytes()}; }

 private:
  [[nodiscard]] MatchResult MatchFromGuess(const MatchInput& input);
  // Holds the patch that a point is matched to.
  struct Pair {
    std::int32_t cell = GaussianMap::kNoCell;             // kNoCell: none
    Eigen::Vector3f from_mean = Eigen::Vector3f::Zero();  // mean to point, grid axes
    float height_m = 0.f;  // so far the point may stand out from the plane (Roughness)
  };
  // Holds the rows that a point adds to the problem at the solution.
  struct PointScore {
    struct OfRow {
      Vector6f gradient;
      Vector6f jacobian;
      float residual_m = 0.f;
      float weight = 0.f;
    };
    int num_rows = 0;  // 0: the point does not count
    std::array<OfRow, 2> rows;
  };
  // How many of the scan's points a cell has.
  struct CellCount {
    std::int32_t num_points = 0;
    std::int32_t count_number = 0;
  };

  // The map has kNumFinerLevels and kNumCoarserLevels more than the options say. Those of the
  // options are in use in wide places, and the coarser ones besides while the support is sparse; in
  // narrow places the finer ones take the place of the coarsest.
  [[nodiscard]] MultiResolutionMap::Levels LevelsInUse() const;
  [[nodiscard]] std::size_t CoarsestOfOptions() const {
    return map_.num_levels() - 1 - kNumCoarserLevels;
  }
  // Adds the share of points that have a plane among the levels of the options.
  void AddShareOnSurfaces();
  // Returns the levels for a correspondence radius. A guess that may be far off is followed by
  // large cells to the end: small ones hold points that are half a cell off elsewhere, and a place
  // is then not found again.
  [[nodiscard]] MultiResolutionMap::Levels LevelsFor(const MatchInput& input,
                                                     double radius_m) const;
  std::vector<Vector3> InGrid(std::span<const Eigen::Vector3f> points,
                              const Pose& T_grid_points) const;
  void Associate(const MatchInput& input, const Pose& T_grid_imu, double radius_m);
  // Counts each cell's points, in one thread. The counts set weights alone, and are kept while the
  // pose hardly moves.
  void CountByCell();
  // One at least, the point itself: it may have moved into the cell since points were counted.
  std::int32_t CountOf(std::int32_t cell) const {
    const CellCount& count = cell_counts_[static_cast<std::size_t>(cell)];
    return count.count_number == count_number_ ? count.num_points : 1;
  }
  // `view` points along the beam, in grid axes, with any length.
  Pair PairOf(const GaussianMap::Hit& hit, const Eigen::Vector3f& view, float relief) const;
  NdtTerm TermOf(const Pair& pair, float radius_var) const;
  MatchSums Linearize(const MatchInput& input, const Pose& T_grid_imu, float radius_var,
                      std::span<PointScore> scores) const;
  // `share` tells how much of a step the point takes (MatchInput::shares_of_correction).
  static void AddTerm(const NdtTerm& term, const SurfacePatch& patch, const Eigen::Vector3f& point,
                      float share, const Eigen::Matrix3f& to_imu, MatchSums& sums,
                      PointScore* score);
  // Fills the support in all, by level and kind of surface.
  void CountSupport(MatchResult& result) const;
  double NewContentShare() const;
  // Along degenerate directions it is that of the mean point. `inverse`: SolvedSums.
  [[nodiscard]] Matrix6 ShareOfLastScan(const MatchSums& sums, const Matrix6& inverse) const;
  Matrix6 ScoreCovariance(const MatchInput& input);
  TurnRate TurnRateError(std::span<const float> from_mid_sweep_s, double curvature_ratio);
  // Tells what each beam saw, for the map to remember.
  std::vector<SeenBeam> BeamsOf(const ScanView& scan, const Eigen::Matrix3f& grid_from_lidar) const;
  // Shows the rows of the match, as they are in scores_, to the calibration of the beams.
  void Teach(const MatchInput& input, const Pose& T_grid_imu) const;
  // Associates and linearises at the pose, with no correspondence radius.
  MatchSums SumsAt(const MatchInput& input, const Pose& T_grid_imu, std::span<PointScore> scores);
  // Fills the result at the pose, and returns the sum of the robust weights there.
  double Finish(const MatchInput& input, const Pose& T_grid_imu, MatchResult& result);

  NdtOptions options_;
  Workers workers_;
  MultiResolutionMap map_;
  Vector3 up_grid_ = Vector3::Zero();  // not known yet: everything stands
  PlaceWidth width_;
  LowMean share_on_surfaces_;
  bool matches_vertical_ = true;         // else planes alone
  std::optional<Vector3> inserted_at_;   // the last scan's place in the map
  float path_m_ = 0.f;                   // the way over all scans that were inserted
  std::vector<Pair> pairs_;              // in the current iteration, one a point
  Pose paired_at_;                       // T_grid_imu of the pairs
  std::optional<Pose> counted_at_;       // T_grid_imu of the counts by cell
  std::vector<PointScore> scores_;       // in the last match, one a point
  MatchScores gradients_;                // by cell and by beam
  std::array<PoseScores, 2> per_metre_;  // by vertical structure, a metre along either direction
  IntraSweepRateEstimator turn_;
  std::vector<CellCount> cell_counts_;
  std::int32_t count_number_ = 0;  // number of the last count; older counts are void
};

}  // namespace lio
