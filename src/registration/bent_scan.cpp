// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/bent_scan.hpp"

namespace lio {

BentScan::BentScan(const MatchInput& input)
    : points_imu_(input.points_imu), shares_(input.shares_of_correction), input_(input) {
  if (shares_.empty()) return;
  const auto [least, most] = std::minmax_element(shares_.begin(), shares_.end());
  least_share_ = *least;
  if (*most > *least) steps_per_share_ = static_cast<float>(kNumSteps) / (*most - *least);
  bent_imu_.resize(points_imu_.size());
  input_.points_imu = bent_imu_;
}

const MatchInput& BentScan::At(const Pose& T_guess_imu) {
  if (shares_.empty()) return input_;
  const Vector6 correction = LogSe3(T_guess_imu);
  std::array<Eigen::Affine3f, kNumSteps + 1> T_imu_instant;
  for (std::size_t i = 0; i < T_imu_instant.size(); ++i) {
    const float share = least_share_ + static_cast<float>(i) / std::max(steps_per_share_, 1e-6f);
    const Pose pose = ExpSe3((static_cast<double>(share) - 1.0) * correction);
    T_imu_instant[i] =
        Eigen::Translation3f(pose.translation.cast<float>()) * pose.rotation.cast<float>();
  }
  for (std::size_t i = 0; i < bent_imu_.size(); ++i) {
    const float step = (shares_[i] - least_share_) * steps_per_share_ + 0.5f;
    bent_imu_[i] = T_imu_instant[static_cast<std::size_t>(step)] * points_imu_[i];
  }
  return input_;
}

}  // namespace lio
