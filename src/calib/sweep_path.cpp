// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/sweep_path.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "lio/filter/preintegration.hpp"

namespace lio {
namespace {

// Returns the velocities at the poses of the natural cubic spline: equal accelerations where pieces
// meet, none at both ends. The system is tridiagonal and solved by elimination (Thomas algorithm).
std::vector<Vector3> SplineVelocities(const StampedPoses& poses) {
  const std::size_t n = poses.size();
  std::vector<double> diagonal(n), above(n);
  std::vector<Vector3> velocities(n, Vector3::Zero());  // the right side first
  const auto inverse_step = [&](std::size_t i) {
    return 1.0 / SecondsBetween(poses[i].stamp, poses[i + 1].stamp);
  };
  for (std::size_t i = 0; i < n; ++i) {
    double below = 0.0;
    for (const bool is_right : {false, true}) {
      if (is_right ? i + 1 == n : i == 0) continue;
      const std::size_t first = is_right ? i : i - 1;
      const double inverse = inverse_step(first);
      (is_right ? above[i] : below) = inverse;
      diagonal[i] += 2.0 * inverse;
      velocities[i] += 3.0 * inverse * inverse *
                       (poses[first + 1].pose.translation - poses[first].pose.translation);
    }
    if (i == 0) continue;
    const double factor = below / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    velocities[i] -= factor * velocities[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) velocities[i] -= above[i] * velocities[i + 1];
    velocities[i] /= diagonal[i];
  }
  return velocities;
}

}  // namespace

SweepPath::SweepPath(StampedPoses known, std::vector<ImuSample> rates_lidar)
    : known_(std::move(known)), rates_(std::move(rates_lidar)) {
  if (known_.size() < 2) throw std::invalid_argument("SweepPath: fewer than two known poses");
  if (rates_.empty()) throw std::invalid_argument("SweepPath: no rates");
  velocities_ = SplineVelocities(known_);
}

std::size_t SweepPath::SegmentOf(Timestamp stamp) const {
  const auto after =
      std::upper_bound(known_.begin(), known_.end(), stamp,
                       [](Timestamp t, const StampedPose& pose) { return t < pose.stamp; });
  const auto at = static_cast<std::size_t>(after - known_.begin());
  return std::clamp<std::size_t>(at, 1, known_.size() - 1) - 1;
}

Vector3 SweepPath::PositionAt(Timestamp stamp) const {
  const std::size_t i = SegmentOf(stamp);
  const double step_s = SecondsBetween(known_[i].stamp, known_[i + 1].stamp);
  const double t_s = SecondsBetween(known_[i].stamp, stamp);
  const Vector3& p0 = known_[i].pose.translation;
  const Vector3& p1 = known_[i + 1].pose.translation;
  if (t_s < 0) return p0 + t_s * velocities_[i];
  if (t_s > step_s) return p1 + (t_s - step_s) * velocities_[i + 1];
  const double s = t_s / step_s;
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * p0 + (3 * s2 - 2 * s3) * p1 +
         step_s * ((s3 - 2 * s2 + s) * velocities_[i] + (s3 - s2) * velocities_[i + 1]);
}

Pose SweepPath::At(Timestamp stamp) const {
  const std::size_t i = SegmentOf(stamp);
  const bool is_nearer_to_next = known_[i + 1].stamp - stamp < stamp - known_[i].stamp;
  const StampedPose& nearest = known_[is_nearer_to_next ? i + 1 : i];
  const bool is_after = stamp >= nearest.stamp;
  const Quaternion turn = Preintegrate(rates_, is_after ? nearest.stamp : stamp,
                                       is_after ? stamp : nearest.stamp, {}, {})
                              .rotation;
  return {(nearest.pose.rotation * (is_after ? turn : turn.conjugate())).normalized(),
          PositionAt(stamp)};
}

StampedPoses SweepPath::Between(Timestamp from, Timestamp to) const {
  StampedPoses poses{{from, At(from)}};
  auto rate =
      std::upper_bound(rates_.begin(), rates_.end(), from,
                       [](Timestamp t, const ImuSample& sample) { return t < sample.stamp; });
  for (; rate != rates_.end() && rate->stamp < to; ++rate) {
    poses.push_back({rate->stamp, At(rate->stamp)});
  }
  if (to > poses.back().stamp) poses.push_back({to, At(to)});
  return poses;
}

}  // namespace lio
