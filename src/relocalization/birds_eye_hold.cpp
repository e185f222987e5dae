// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_hold.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lio/registration/registration_parameters.hpp"
#include "lio/relocalization/parameters.hpp"
#include "relocalization/place_candidates.hpp"

namespace lio {
namespace {

using LevelRows = Eigen::Matrix<double, 2, 6>;

// Returns the Jacobian of the position along the level axes' x and y by a right increment.
LevelRows LevelJacobian(const Quaternion& R_level_map, const MatchResult& match) {
  LevelRows H = LevelRows::Zero();
  H.leftCols<3>() = (R_level_map * match.T_map_imu.rotation).toRotationMatrix().topRows<2>();
  return H;
}

// Returns the match's covariance with those degenerate directions alone that are seen from above.
// Along any other, as up a stairwell, a small step to the side would stand for a large one.
std::optional<Matrix6> CovSeenFromAbove(const LevelRows& H, const MatchResult& match) {
  constexpr double kStd_m = DegeneracyParameters::kDegenerateStd_m;
  bool is_seen = false;
  Matrix6 cov = match.observable_cov;
  for (const BlindDirection& blind : match.blind_directions) {
    if ((H * blind.shift).norm() < kRelocalization.shift.min_level_share) continue;
    cov += kStd_m * kStd_m * blind.shift * blind.shift.transpose();
    is_seen = true;
  }
  return is_seen ? std::optional(cov) : std::nullopt;
}

// Makes a linear (Kalman) update of the imu's position along the level axes' x and y. The gain is
// by `cov`, and the covariance right for any gain.
void HoldAt(const FoundShift& found, const LevelRows& H, const Matrix6& cov,
            const Quaternion& R_level_map, MatchResult& match) {
  const Eigen::Vector2d residual =
      found.position_m - (R_level_map * match.T_map_imu.translation).head<2>();
  const Eigen::Matrix2d innovation_cov = H * cov * H.transpose() + found.cov;
  const Eigen::Matrix<double, 6, 2> gain = cov * H.transpose() * innovation_cov.inverse();
  match.T_map_imu = match.T_map_imu * ExpSe3(gain * residual);
  const Matrix6 left = Matrix6::Identity() - gain * H;
  match.cov = left * match.cov * left.transpose() + gain * found.cov * gain.transpose();
}

Eigen::Vector2f PositionOf(const MatchResult& match, const Quaternion& R_level_map) {
  return (R_level_map * match.T_map_imu.translation).head<2>().cast<float>();
}

// Things stand alike along a corridor: a place that the prediction leaves no room for is another
// one.
float SearchRange_m(const LevelRows& H, const Matrix6& prior_cov) {
  const double std_m =
      std::sqrt(std::max(0.0, (H * prior_cov * H.transpose()).diagonal().maxCoeff()));
  return static_cast<float>(std::clamp(kRelocalization.shift.range_sigmas * std_m,
                                       kRelocalization.shift.min_range_m,
                                       kRelocalization.shift.max_range_m));
}

}  // namespace

void BirdsEyeHold::Apply(std::span<const Eigen::Vector3f> points_imu, const Quaternion& R_level_map,
                         const Matrix6& prior_cov, MatchResult& match) {
  const Eigen::Vector2f matched_m = PositionOf(match, R_level_map);
  const bool is_apart = views_.empty() || (matched_m - views_.back().position_m).norm() >=
                                              kRelocalization.shift.view_spacing_m;
  if (match.degenerate_mask == 0 && !is_apart) return;
  BirdsEyeView view(Levelled(points_imu, R_level_map * match.T_map_imu.rotation));
  if (match.degenerate_mask != 0 && !views_.empty()) {
    const LevelRows H = LevelJacobian(R_level_map, match);
    if (const auto cov = CovSeenFromAbove(H, match)) {
      const auto found = FindShift(views_, view, matched_m, SearchRange_m(H, prior_cov));
      if (found) HoldAt(*found, H, *cov, R_level_map, match);
    }
  }
  if (!is_apart) return;
  if (views_.size() == kRelocalization.shift.max_views) views_.erase(views_.begin());
  views_.push_back({PositionOf(match, R_level_map), std::move(view)});
}

}  // namespace lio
