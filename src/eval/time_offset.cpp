// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/time_offset.hpp"

#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lio {
namespace {

constexpr double kSpan_s = 1.0;
constexpr double kStep_s = 0.05;  // step of the coarse search
constexpr double kResolution_s = 1e-4;

double PositionError(const Trajectory& truth, const Trajectory& estimate,
                     std::optional<double> max_gap_s) {
  const PosePairs pairs = Associate(truth, estimate, max_gap_s).pairs;
  const Pose T_truth_estimate = Align(pairs, AlignMode::kSe3).T_truth_estimate;
  double sum_sq = 0.0;
  for (const PosePair& pair : pairs) {
    sum_sq += (T_truth_estimate * pair.estimate.translation - pair.truth.translation).squaredNorm();
  }
  return std::sqrt(sum_sq / static_cast<double>(pairs.size()));
}

}  // namespace

Trajectory Shifted(const Trajectory& estimate, double offset_s) {
  Trajectory shifted = estimate;
  for (StampedPose& row : shifted.poses) {
    row.stamp = row.stamp + Duration::FromSeconds(offset_s);
  }
  return shifted;
}

double FindTimeOffset(const Trajectory& truth, const Trajectory& estimate,
                      std::optional<double> max_gap_s) {
  for (const Trajectory* trajectory : {&truth, &estimate}) {
    if (trajectory->format == TrajectoryFormat::kTum) continue;
    throw std::runtime_error("a time offset needs files with stamps; KITTI files have none");
  }
  const auto error_m = [&](double offset_s) {
    return PositionError(truth, Shifted(estimate, offset_s), max_gap_s);
  };
  double best_s = 0.0;
  double least_m = std::numeric_limits<double>::infinity();
  const int num_steps = static_cast<int>(std::lround(kSpan_s / kStep_s));
  for (int i = -num_steps; i <= num_steps; ++i) {
    const double found_m = error_m(i * kStep_s);
    if (found_m >= least_m) continue;
    least_m = found_m;
    best_s = i * kStep_s;
  }
  constexpr int kBits = 20;  // accuracy of the minimum
  const double fine_s =
      boost::math::tools::brent_find_minima(error_m, best_s - kStep_s, best_s + kStep_s, kBits)
          .first;
  return std::round(fine_s / kResolution_s) * kResolution_s;
}

}  // namespace lio
