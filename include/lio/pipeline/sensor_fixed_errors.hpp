// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How far errors that move with the sensor bend the map, as the drive itself shows it. Points of
// one beam direction that are wrong in the same way have the same score (gradient) in every match:
// the mean of their scores over many scans is what neither points nor scans average away.
#pragma once

#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct SensorFixedErrorParameters {
  // Scans in the mean. Chosen: five seconds at 10 Hz, after which 1 % of the squared score of one
  // scan is left as noise; 25 and 200 change no NEES by more than a quarter
  // (docs/experiments/sensor_fixed_errors.md).
  int num_scans = 50;
};

inline constexpr SensorFixedErrorParameters kSensorFixedErrors;

class SensorFixedErrors {
 public:
  // A match without scores by beam direction is skipped.
  void Add(const MatchResult& match);
  // The covariance that such errors alone give the pose of this match, right error [m; rad]: the
  // middle of the sandwich is the sum over beam directions of m m^T, m the mean score.
  [[nodiscard]] Matrix6 CovOf(const MatchResult& match) const;
  void Reset() { *this = {}; }

 private:
  std::vector<Vector6> mean_scores_;
  int num_scans_ = 0;
};

}  // namespace lio
