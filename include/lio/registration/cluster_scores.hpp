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
    for (const std::int32_t part : parts_) place_of_[static_cast<std::size_t>(part)] = kNone;
    parts_.clear();
    sums_.clear();
    if (place_of_.size() < num_parts) place_of_.resize(num_parts, kNone);
  }

  void Add(std::int32_t part, const Score& score) {
    std::int32_t& place = place_of_[static_cast<std::size_t>(part)];
    if (place == kNone) {
      place = static_cast<std::int32_t>(sums_.size());
      sums_.push_back(score);
      parts_.push_back(part);
    } else {
      sums_[static_cast<std::size_t>(place)] += score;
    }
  }

  // Returns the sum over parts of score score^T.
  [[nodiscard]] Square SumOfSquares() const {
    Square sum = Square::Zero();
    for (const Score& of_part : sums_) {
      const auto score = of_part.template cast<double>().eval();
      sum += score * score.transpose();
    }
    return sum;
  }

  // Returns the same, corrected for the estimated dimensions: that of the gradient of the whole
  // cost.
  [[nodiscard]] Square Covariance() const {
    const auto num_parts = static_cast<double>(sums_.size());
    return num_parts / std::max(1.0, num_parts - kDims) * SumOfSquares();
  }

 private:
  static constexpr std::int32_t kNone = -1;

  std::vector<Score> sums_;             // by part, in the order in which they came
  std::vector<std::int32_t> parts_;     // the part of each
  std::vector<std::int32_t> place_of_;  // by part: its place among the sums
};

using PoseScores = ClusterScores<6>;

}  // namespace lio
