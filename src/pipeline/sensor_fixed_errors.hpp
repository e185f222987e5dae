// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how far errors that move with the sensor bend the map, as the drive itself shows it. Points
// of one beam direction that are wrong in the same way have the same score (gradient) in every
// match: the mean of their scores over the drive is what neither points nor scans average away.
//
// A match is off by A^-1 m, with m the mean score and A the curvature of its cost, and a scan that
// is inserted there carries the error into its share of the map. After N replacements of the map by
// new content the drift is N A^-1 m, with the covariance N^2 S where S = A^-1 (sum m m^T) A^-1, the
// sum over beam directions. It therefore grows by 2 N S per replacement, and no constant says how
// long such errors last: scores that change sign leave a small mean. Once the beams' errors are
// found and taken off (registration/beam_calibration.hpp), the scores become too small, since the
// found errors are fitted to them, and the covariance of what is left of the errors is too large by
// the scores of before. Each tells the whole, and the mean of both sums is taken.
#pragma once

#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

class SensorFixedErrors {
 public:
  // A match whose scan goes into the map. One without scores by beam direction is skipped.
  void Add(const MatchResult& match);
  // Such errors alone let the covariance of the map's pose grow by this per share of new content;
  // right error [m; rad].
  [[nodiscard]] Matrix6 CovPerReplacement(const MatchResult& match) const;
  // A map begins: nothing of it has been replaced yet. The errors are those of the sensor.
  void BeginMap() { num_replacements_ = 0.0; }
  // The extrinsic has been corrected: poses and scores are of another body from here on.
  // `T_old_new`: the new imu in the old one's axes.
  void SetImu(const Pose& T_old_new);

 private:
  std::vector<Vector6> mean_scores_;  // weighted by the shares of new content
  double sum_of_shares_ = 0.0;
  double num_replacements_ = 0.0;  // the same sum, of the map at hand
};

}  // namespace lio
