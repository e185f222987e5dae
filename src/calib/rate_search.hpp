// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The first guess of a calibration: the clock offset at which turn rates of lidar and gyro agree
// best, with the rotation between them and the gyro's bias in closed form.
#pragma once

#include <span>
#include <vector>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

// From one sweep to the next.
struct LidarTurn {
  Timestamp from, to;      // of the lidar's clock
  Vector3 rotation_lidar;  // rotation vector, rad, in the lidar's axes at `from`
  double span_s() const { return SecondsBetween(from, to); }
};

struct RateMatch {
  double offset_s = 0.0;
  Matrix3 R_imu_lidar = Matrix3::Identity();
  Vector3 gyro_bias_radps = Vector3::Zero();
  double correlation = 0.0;          // 0..1
  double second_axis_ratio = 0.0;    // how much turning there is about other axes than the first
  double gyro_rate_rms_radps = 0.0;  // about its mean
  int num_turns = 0;
};

class RateSearch {
 public:
  RateSearch(std::span<const ImuSample> samples, std::span<const LidarTurn> turns);

  // The best of a grid over +-max_offset_s, refined between its points.
  RateMatch Run(double max_offset_s) const;
  RateMatch At(double offset_s) const;

 private:
  // Integral of the rates from the first sample on, and whether samples were missing up to there.
  struct Sum {
    Vector3 angle;
    int num_gaps;
  };
  bool SumAt(double t_s, Sum& sum) const;  // false outside the samples and in their holes

  std::span<const LidarTurn> turns_;
  Timestamp begin_;
  std::vector<double> t_s_;
  std::vector<Sum> sums_;
};

}  // namespace lio
