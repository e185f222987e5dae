// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores (gradients of a term's cost) summed per part of the map. Terms of one part share its
// errors, so that the covariance of the whole gradient is estimated from the sums of parts: the
// middle of the clustered sandwich covariance H^-1 (sum_c g_c g_c') H^-1.
// Source: Liang, Zeger, "Longitudinal data analysis using generalized linear models", Biometrika
// 73(1), 1986, with the usual correction G / (G - dims) for G clusters.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace lio {

// `kDims` is the number of unknowns.
template <int kDims>
class ClusterScores {
 public:
  using Score = Eigen::Matrix<float, kDims, 1>;
  using Square = Eigen::Matrix<double, kDims, kDims>;

  // Forgets all scores. `num_parts` is an upper bound of the parts' numbers.
  void Reset(std::size_t num_parts) {
    for (const std::int32_t part : parts_) is_used_[static_cast<std::size_t>(part)] = 0;
    parts_.clear();
    if (by_part_.size() < num_parts) {
      by_part_.resize(num_parts);
      is_used_.assign(num_parts, 0);
    }
  }

  void Add(std::int32_t part, const Score& score) {
    const auto i = static_cast<std::size_t>(part);
    if (!is_used_[i]) {
      is_used_[i] = 1;
      by_part_[i].setZero();
      parts_.push_back(part);
    }
    by_part_[i] += score;
  }

  // Returns the sum over parts of score score^T.
  [[nodiscard]] Square SumOfSquares() const {
    Square sum = Square::Zero();
    for (const std::int32_t part : parts_) {
      const auto score = by_part_[static_cast<std::size_t>(part)].template cast<double>().eval();
      sum += score * score.transpose();
    }
    return sum;
  }

  // Returns the same, corrected for the estimated dimensions: that of the gradient of the whole
  // cost.
  [[nodiscard]] Square Covariance() const {
    const auto num_parts = static_cast<double>(parts_.size());
    return num_parts / std::max(1.0, num_parts - kDims) * SumOfSquares();
  }

 private:
  std::vector<Score> by_part_;
  std::vector<std::int32_t> parts_;  // in use
  std::vector<std::uint8_t> is_used_;
};

using PoseScores = ClusterScores<6>;

}  // namespace lio
