// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines scan-to-map registration: one interface, several methods. A matcher owns its map. The
// pose it measures is that of the imu in the map's frame, at the sweep's middle; points come in the
// imu frame at that instant, already deskewed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/beam_calibration.hpp"
#include "lio/registration/match_status.hpp"
#include "lio/registration/registration_parameters.hpp"
#include "lio/scan/feature_tag.hpp"
#include "lio/scan/reduced_scan.hpp"

namespace lio {

// Holds points of a scan and, for methods that use features, the kind of each.
struct ScanView {
  std::span<const Eigen::Vector3f> points_imu;
  std::span<const FeatureTag> tags = {};  // one a point; empty where the method needs none
  Pose T_imu_lidar = {};                  // the lidar's place
  // The same points in the lidar frame, each at its own instant, and the errors that were taken off
  // them; empty where the beams are not known.
  std::span<const ScanPoint> beam_points = {};
  const BeamErrors* corrected = nullptr;
  double range_std_m = 0.0;  // noise of the ranges; 0: not known
};

struct TurnRate {
  Vector3 w_imu_radps = Vector3::Zero();
  Matrix3 cov = Matrix3::Zero();
};

struct MatchInput {
  std::span<const Eigen::Vector3f> points_imu;
  Pose T_map_imu_guess;
  // The guess has this right error, [translation; rotation]: it sets the correspondence radius. It
  // is not a prior: it stays out of the cost.
  Matrix6 guess_cov = Matrix6::Zero();
  bool is_far_off = false;  // the guess may be far off: take more iterations before giving up
  std::span<const FeatureTag> tags = {};                  // one per point of points_imu
  std::span<const Eigen::Vector3f> scan_points_imu = {};  // the whole scan, to fit normals in
  // The guessed translation since the last scan has this standard deviation. Things that look
  // different from each side (trunks, bushes) are left out where it is known better than they can
  // tell (WellConstrainedTranslationParameters).
  double shift_std_m = 1.0;
  // Each of points_imu has its time here; given only where the rate within the sweep is asked for.
  std::span<const float> from_mid_sweep_s = {};
  // How much of the correction of the guess each point's own instant takes, of points_imu: 1 at the
  // instant that the points are deskewed to. Empty: the scan is rigid. Only the method ndt bends
  // it.
  std::span<const float> shares_of_correction = {};
  Pose T_imu_lidar = {};  // tells the points' beams apart, and where surfaces are seen from
  // Learns from the match, where given, and each of points_imu as its beam saw it. Only the method
  // ndt teaches it.
  BeamCalibration* calibration = nullptr;
  std::span<const ScanPoint> beam_points = {};
  // Degenerate directions are solved, too, held by the guess with its covariance; only the method
  // ndt does so.
  bool solves_degenerate = false;
};

// The whole scan is inserted, of which a part, evenly spread, is matched: so many points go into
// the map for each matched one.
[[nodiscard]] inline double InsertedPerMatched(const MatchInput& input) {
  const std::size_t num_matched = input.points_imu.size();
  const std::size_t num_inserted = std::max(input.scan_points_imu.size(), num_matched);
  return static_cast<double>(num_inserted) / static_cast<double>(num_matched);
}

// Counts points that come to a surface of the map, and those of them that lie on it.
struct Support {
  int num_in_map = 0;
  int num_matched = 0;

  void Add(bool is_matched) {
    ++num_in_map;
    if (is_matched) ++num_matched;
  }
};

// Counts the points of surfaces that stand, by 45 deg or more.
struct UprightSupport {
  Support all;
  // Those of vertical structures that are no planes. A match may leave them out where the shift
  // since the last scan is known to centimetres.
  Support structures;
};

// A degenerate direction, which the noise of the cells' normals turns a little in each match.
struct BlindDirection {
  Vector6 shift = Vector6::Zero();   // right increment [translation (m); rotation (rad)] by a unit
  Vector6 weight = Vector6::Zero();  // weight . increment is how many units it has
  // Covariance of `shift`, across itself: how the direction varies from match to match. Zero where
  // the method does not tell.
  Matrix6 cov = Matrix6::Zero();
};

// The information that counts for SplitDirections(), that which noise alone induces, and what holds
// the match.
struct Observability {
  Matrix6 counted = Matrix6::Zero();
  Matrix6 noise = Matrix6::Zero();
  // Phi = H^-1 sum_c phi_c H_c, with H_c the information of the points in cell c of the map, H
  // their sum and phi_c the share of the cell that the last inserted scan brought: so much of a
  // shift of that scan (right error) shifts this match. Given where the method tells.
  std::optional<Matrix6> share_of_last_scan;

  // Returns the ratio of counted to noise along an increment.
  [[nodiscard]] double Ratio(const Vector6& shift) const {
    return shift.dot(counted * shift) / shift.dot(noise * shift);
  }
};

// Errors of beams pull a match by these.
struct BeamPull {
  // Gradients of the cost by beam direction (BeamScores); empty where there is no map that lasts.
  std::vector<Vector6> scores;
  // Covariance of the gradient by what is not known of the beams' errors (BeamCalibration); absent
  // as long as none are known.
  std::optional<Matrix6> unknown_cov;
};

// Counts matched points by the level of the map; zero where the method has no levels.
struct MatchedByLevel {
  LevelCounts counts{};
  int num_in_finest = 0;  // at the finest level in use, which depends on the place
};

struct [[nodiscard]] MatchResult {
  MatchStatus status = MatchStatus::kEmptyMap;
  Pose T_map_imu;                         // under every status; the guess where nothing was matched
  Matrix6 information = Matrix6::Zero();  // Hessian of the cost at the solution, right error
  Observability observability;
  Matrix6 cov = Matrix6::Zero();  // error of T_map_imu, right; 100 m along degenerate directions
  Matrix6 observable_cov =
      Matrix6::Zero();                    // the same without the part along degenerate directions
  Vector6 eigenvalues = Vector6::Zero();  // the information's, rotations scaled to metres
  unsigned degenerate_mask = 0;           // bit i: eigenvalue i is of a degenerate direction
  std::vector<BlindDirection> blind_directions;  // one for each bit
  int num_matched = 0;
  MatchedByLevel by_level;
  // So many points lie where the map has a surface, near or far from it; 0 where the method does
  // not tell.
  int num_in_map = 0;
  UprightSupport upright;  // floors and ceilings fit anywhere
  int iterations = 0;
  double residual_rms_m = 0.0;
  // The turn rate that the scan was deskewed by errs by this; given where asked for and the method
  // can.
  std::optional<TurnRate> turn_rate_error;
  BeamPull beam_pull;
  // A unit of gradient shifts the pose by this, right error: the robust cost's curvature inverted,
  // without degenerate directions.
  Matrix6 shift_per_score = Matrix6::Zero();
  double new_content_share = 1.0;  // 0..1, share of the matched map that this scan brings
  // The support that the scan has at the guess, over that at T_map_imu: near one, the scan lies as
  // well at either. Given where the two contradict each other and the method tells.
  std::optional<double> support_at_guess;

  // The two contradict each other, and the scan lies as well at the guess: it has slid.
  [[nodiscard]] bool HasSlid() const {
    return support_at_guess > MatchParameters::kMaxSupportAtGuess;
  }
  [[nodiscard]] bool IsUsable() const {
    return status == MatchStatus::kConverged || status == MatchStatus::kDegenerate;
  }
};

class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;

  [[nodiscard]] virtual MatchResult Match(const MatchInput& input) = 0;
  virtual void Insert(const ScanView& scan, const Pose& T_map_imu) = 0;
  // Adds the points of a saved map, which stay for good. False, and nothing is added, where the
  // method has no use for points without a scan.
  [[nodiscard]] virtual bool InsertKept(std::span<const Eigen::Vector3f> /*points_map*/) {
    return false;
  }
  virtual void Clear() = 0;
  // Sets the vertical's direction in the map, to some 10 deg; call it before the first Insert().
  virtual void SetUp(const Vector3& /*up_map*/) {}
  struct MapSize {
    std::size_t num_cells = 0;
    std::size_t memory_bytes = 0;
  };
  [[nodiscard]] virtual MapSize map_size() const = 0;
};

}  // namespace lio
