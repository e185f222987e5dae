// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The first guess of a calibration: the clock offset at which the turn rates of lidar and gyro
// correlate best, with the rotation between them (Kabsch, Acta Cryst. 1976) and the gyro's bias in
// closed form. docs/calibration.md has the formulas. Nothing throws.
#pragma once

#include <span>
#include <vector>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Holds the turn from one sweep to the next.
struct LidarTurn {
  Timestamp from, to;      // by the lidar's clock
  Vector3 rotation_lidar;  // rotation vector, rad, in the lidar's axes at `from`
  double span_s() const { return SecondsBetween(from, to); }
};

struct RateMatch {
  double offset_s = 0.0;
  Matrix3 R_imu_lidar = Matrix3::Identity();
  Vector3 gyro_bias_radps = Vector3::Zero();
  double correlation = 0.0;          // 0..1
  double second_axis_ratio = 0.0;    // second to first singular value of the turn rates
  double gyro_rate_rms_radps = 0.0;  // after subtraction of the mean
  int num_turns = 0;
};

class RateSearch {
 public:
  RateSearch(std::span<const ImuSample> samples, std::span<const LidarTurn> turns);

  // Returns the best offset of a grid over +-max_offset_s, refined between its points. The
  // correlation is 0 when there are too few turns.
  RateMatch Run(double max_offset_s) const;
  // Returns the agreement at one offset.
  RateMatch At(double offset_s) const;

 private:
  // Holds the integral of the rates from the first sample (rad, imu), and the number of holes up to
  // there.
  struct Sum {
    Vector3 angle;
    int num_gaps;
  };
  // Holds the mean rates of one turn after another, by gyro and lidar.
  struct Rates {
    std::vector<Vector3> gyro, lidar;
  };
  Rates RatesAt(double offset_s) const;
  // Returns false outside the samples and in their holes.
  [[nodiscard]] bool SumAt(double t_s, Sum& sum) const;

  std::span<const LidarTurn> turns_;
  Timestamp begin_;
  std::vector<double> t_s_;
  std::vector<Sum> sums_;
};

}  // namespace lio
