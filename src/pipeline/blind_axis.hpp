// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Remembers the one direction along which matches see nothing, such as the axis of a tunnel.
//
// Each match finds that direction anew, off by a milliradian at random, because the normals of its
// cells are noisy. Taken as they come, such directions contradict each other: a height that is
// measured to a millimetre, once along an axis that rises by a milliradian and once along one that
// falls by as much, would tell the place along the tunnel to a metre, and a second of scans its
// velocity to 0.1 m/s. Nothing has seen either. So the direction is the mean over the scans for as
// long as they agree. It is a twist: one that slides along a straight or a circular tunnel stays
// the same as the body moves and turns, where Ad(D^-1) takes it along by the motion D.
//
// In such a place some matches pass the limit below which a direction counts as blind, by chance.
// They are believed once they tell clearly more than the blind ones did.
#pragma once

#include <Eigen/Cholesky>
#include <optional>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct BlindAxisParameters {
  // Directions that differ by more than this begin a mean anew. Statistics: 99.9 % of chi-square
  // with five degrees of freedom.
  double max_chi_square = 20.5;
  // Older scans are forgotten by this share. Chosen: 50 scans, a tunnel's bend of 75 m at 15 m/s.
  double forgotten_share = 0.02;
  // Half a unit along the measured direction. Chosen: what is less is another direction.
  double min_length = 0.5;
  // A match that tells less than this many times what blind ones told here is blind, too. Chosen:
  // they differ by a fifth, and at the end of a tunnel the ratio is soon ten.
  double min_information_ratio = 2.0;
};
inline constexpr BlindAxisParameters kBlindAxis;

class BlindAxis {
 public:
  // Takes a match into the mean, and returns the covariance of its pose with that direction in
  // place of its own. It is the match's where none or several directions are blind, or its method
  // does not tell how well it knows them.
  [[nodiscard]] Matrix6 CovOf(const MatchResult& match);

 private:
  void Transport(const Pose& T_map_imu);
  [[nodiscard]] bool SeesNoMoreThanBefore(const MatchResult& match) const;
  [[nodiscard]] Matrix6 BlindCov() const;
  void Take(const BlindDirection& measured, double information);
  [[nodiscard]] bool Agrees(const BlindDirection& measured);
  [[nodiscard]] Eigen::LDLT<Matrix6> Spread(const BlindDirection& measured) const;

  struct Mean {
    Vector6 shift;  // as BlindDirection's
    Matrix6 cov;
    double information;  // along it, of blind matches
  };
  std::optional<Mean> mean_;
  Pose T_map_imu_;  // of the last match
};

}  // namespace lio
