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
// The error of a direction is that of the cells around, which many scans share: n blind matches
// tell no more of it than one. So a match that is the n-th blind one in a row has n times
// the covariance of its direction, times the variance of the motion that nobody saw. Without that
// a velocity that is off by metres a second is claimed to 0.1 m/s on rough ground between hedges
// (docs/experiments/rough_ground.md).
//
// In such a place some matches pass the limit below which a direction counts as blind, by chance.
// A match is believed there, as long as most of the last ones were blind, if it tells clearly more
// than those (docs/experiments/blind_axis.md).
#pragma once

#include <optional>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct BlindAxisParameters {
  // Directions that differ by more than this begin a mean anew. Statistics: 99.9 % of chi-square
  // with five degrees of freedom.
  double max_chi_square = 20.5;
  // A scan makes older ones count less by this share. Chosen: the mean is over 50 scans, which are
  // 75 m of a tunnel at 15 m/s and 10 Hz.
  double forgotten_share = 0.02;
  // The share of blind matches is a mean over the last ones with this weight. Chosen: ten scans.
  double share_rate = 0.1;
  // A mean that has less than this along a measured direction is another direction. Chosen: half of
  // the measured one's length.
  double min_length = 0.5;
  // A match whose ratio of information to noise is less than this many times that of blind ones is
  // blind, too. Chosen: blind matches differ by a fifth, and at the end of a tunnel the ratio is
  // soon ten times as large.
  double min_information_ratio = 2.0;
};
inline constexpr BlindAxisParameters kBlindAxis;

// Returns the match's covariance, and what the errors of its blind directions add to it: a motion
// along one, unseen and as uncertain as the prior, is taken for one across by as much as the
// direction is turned. `num_alike`: so many matches share the errors of their directions and count
// as one. Covariances are of right errors [m; rad].
[[nodiscard]] Matrix6 WithBlindErrors(const MatchResult& match, const Matrix6& prior_cov,
                                      int num_alike = 1);

class BlindAxis {
 public:
  struct Answer {
    Matrix6 cov;    // the error of the match's pose, right [m; rad]
    bool is_blind;  // along one direction at least
  };
  // Takes a match into the mean, and returns its covariance with that direction in place of its
  // own. It is WithBlindErrors() where several directions are blind, and the match's where none is
  // or its method does not tell how they vary. `prior_cov` is that of the pose before the match.
  [[nodiscard]] Answer Judge(const MatchResult& match, const Matrix6& prior_cov);

  // The matches to come are in another map, of another body, or somewhere else.
  void Reset() { *this = {}; }

 private:
  void Transport(const Pose& T_map_imu);
  [[nodiscard]] bool IsBlindByChance(const MatchResult& match) const;
  [[nodiscard]] Matrix6 BlindCov() const;
  void Take(const BlindDirection& measured, double information_ratio);
  [[nodiscard]] bool AlignTo(const BlindDirection& measured);
  [[nodiscard]] bool Fuse(const BlindDirection& measured, double information_ratio);

  struct Mean {
    Vector6 shift;  // as BlindDirection's
    Matrix6 cov;
    double information_ratio;  // along it, of blind matches
  };
  std::optional<Mean> mean_;
  double blind_share_ = 0.0;  // mean over the last matches
  int num_blind_ = 0;         // in a row
  Pose T_map_imu_;            // the last match's
};

}  // namespace lio
