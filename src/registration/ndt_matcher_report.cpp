// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells of a match at its solution what its cost does not say: the covariance of the gradient, the
// shares of new and of last content, the error of the turn rate, and the support by kind.
#include <algorithm>

#include "lio/map/map_parameters.hpp"
#include "lio/registration/ndt_matcher.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

double NdtMatcher::NewContentShare() const {
  const auto mean = workers_.SumOverBlocks<NewContentMean>(pairs_.size(), [&](const Block& block) {
    NewContentMean of_block;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const std::int32_t cell = pairs_[i].cell;
      if (cell == GaussianMap::kNoCell) continue;
      if (map_.IsFrozen(cell)) {
        of_block.AddFrozen();
      } else {
        of_block.Add(static_cast<double>(map_.patch(cell).num_points), CountOf(cell));
      }
    }
    return of_block;
  });
  return mean.share();
}

Matrix6 NdtMatcher::ShareOfLastScan(const MatchSums& sums, const Matrix6& inverse) const {
  TermSum of_last;
  double sum_of_shares = 0.0;
  for (std::size_t k = 0; k < scores_.size(); ++k) {
    const auto num_rows = static_cast<std::size_t>(scores_[k].num_rows);
    if (num_rows == 0) continue;
    const float share =
        std::min(NdtParameters::kMaxShareOfLastScan, map_.ShareOfLastScan(pairs_[k].cell));
    if (share == 0.f) continue;
    sum_of_shares += static_cast<double>(share);
    for (std::size_t i = 0; i < num_rows; ++i) {
      const PointScore::OfRow& row = scores_[k].rows[i];
      of_last.Add(row.jacobian, share * row.weight);
    }
  }
  const Matrix6 blind = Matrix6::Identity() - inverse * sums.information.Full();
  return inverse * of_last.Full() + sum_of_shares / sums.num_matched * blind;
}

Matrix6 NdtMatcher::ScoreCovariance(const MatchInput& input) {
  gradients_.Reset(map_.cell_capacity(), input.T_imu_lidar);
  for (PoseScores& per_metre : per_metre_) per_metre.Reset(map_.cell_capacity());
  for (std::size_t k = 0; k < scores_.size(); ++k) {
    const auto num_rows = static_cast<std::size_t>(scores_[k].num_rows);
    for (std::size_t i = 0; i < num_rows; ++i) {
      const PointScore::OfRow& row = scores_[k].rows[i];
      gradients_.Add(input.points_imu[k], {pairs_[k].cell, row.weight, row.jacobian, row.gradient});
      if (num_rows == 2) per_metre_[i].Add(pairs_[k].cell, row.weight * row.jacobian);
    }
  }
  constexpr double kSharedStd_m = NdtParameters::kSharedVerticalStd_m;
  const Matrix6 sides = per_metre_[0].SumOfSquares() + per_metre_[1].SumOfSquares();
  return gradients_.Covariance() + kSharedStd_m * kSharedStd_m * sides;
}

TurnRate NdtMatcher::TurnRateError(std::span<const float> from_mid_sweep_s,
                                   double curvature_ratio) {
  turn_.Reset(map_.cell_capacity());
  for (std::size_t k = 0; k < scores_.size(); ++k) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(scores_[k].num_rows); ++i) {
      const PointScore::OfRow& row = scores_[k].rows[i];
      turn_.Add(pairs_[k].cell, row.jacobian, row.residual_m, row.weight, from_mid_sweep_s[k]);
    }
  }
  return turn_.Solve(curvature_ratio);
}

void NdtMatcher::CountSupport(MatchResult& result) const {
  const Eigen::Vector3f up = up_grid_.cast<float>();
  Support all;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const std::int32_t cell = pairs_[i].cell;
    if (cell == GaussianMap::kNoCell) continue;
    const bool is_matched = scores_[i].num_rows > 0;
    const SurfacePatch& patch = map_.patch(cell);
    const bool is_vertical = patch.kind == SurfacePatch::Kind::kVertical;
    const float along_up = patch.normal.dot(up);
    all.Add(is_matched);
    if (is_vertical) result.upright.structures.Add(is_matched);
    if (is_vertical || along_up * along_up <= 0.5f) result.upright.all.Add(is_matched);
    if (is_matched) ++result.by_level.counts[map_.LevelOf(cell)];
  }
  result.num_in_map = all.num_in_map;
  result.num_matched = all.num_matched;
  result.by_level.num_in_finest = result.by_level.counts[LevelsInUse().finest];
}

void NdtMatcher::AddShareOnSurfaces() {
  if (pairs_.empty()) return;
  const auto num = std::ranges::count_if(pairs_, [&](const Pair& pair) {
    return pair.cell != GaussianMap::kNoCell && map_.LevelOf(pair.cell) <= CoarsestOfOptions() &&
           map_.patch(pair.cell).kind == SurfacePatch::Kind::kPlane;
  });
  share_on_surfaces_.Add(static_cast<double>(num) / static_cast<double>(pairs_.size()),
                         SparseSupportParameters::kSparseBelow,
                         SparseSupportParameters::kDenseAbove);
}

}  // namespace lio
