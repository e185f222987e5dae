// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lio/relocalization/parameters.hpp"
#include "lio/relocalization/place_search.hpp"

namespace lio {
namespace {

constexpr PlaceCandidateParameters kCandidate = kRelocalization.candidate;

double LargestStd(const Matrix3& cov) {
  return std::sqrt(std::max(0.0, cov.diagonal().maxCoeff()));
}

}  // namespace

std::vector<Eigen::Vector3f> Levelled(std::span<const Eigen::Vector3f> points_imu,
                                      const Quaternion& R_level_imu) {
  const Eigen::Matrix3f R = R_level_imu.toRotationMatrix().cast<float>();
  std::vector<Eigen::Vector3f> levelled;
  levelled.reserve(points_imu.size());
  for (const Eigen::Vector3f& point : points_imu) levelled.emplace_back(R * point);
  return levelled;
}

Quaternion LevelFromMap(const Vector3& up_map) {
  return Quaternion::FromTwoVectors(up_map, Vector3::UnitZ());
}

std::vector<Pose> PlaceCandidates(const PlacedScan& earlier, const PlacedScan& now,
                                  const Matrix6& cov, const Quaternion& R_level_map,
                                  bool was_unseen) {
  const Quaternion R_level_imu = R_level_map * earlier.T_map_imu.rotation;
  const Vector3 moved_level =
      R_level_map * (now.T_map_imu.translation - earlier.T_map_imu.translation);
  const double turned_rad = YawOf(R_level_map * now.T_map_imu.rotation * R_level_imu.conjugate());
  const double shift_m = kCandidate.range_sigmas * LargestStd(cov.topLeftCorner<3, 3>());
  const double turn_rad = kCandidate.range_sigmas * LargestStd(cov.bottomRightCorner<3, 3>());
  const double half_way = was_unseen ? 0.5 : 0.0;
  const Vector3 range_m =
      (half_way * moved_level.cwiseAbs().array() + shift_m).min(kCandidate.max_shift_m).matrix();
  const Vector3 middle_m = (1.0 - half_way) * moved_level;
  const PlanarPose middle{middle_m.head<2>().cast<float>(), static_cast<float>(turned_rad)};
  const PlanarRange range{range_m.head<2>().cast<float>(),
                          static_cast<float>(std::min(turn_rad, std::numbers::pi))};
  const BirdsEyeView view_then(Levelled(earlier.points_imu, R_level_imu));
  const BirdsEyeView view_now(Levelled(now.points_imu, R_level_imu));
  std::vector<Pose> candidates;
  for (const PlanarPose& flat : FindPlaces(view_then, view_now, middle, range)) {
    const Vector3 shift_level(flat.shift_m.x(), flat.shift_m.y(), moved_level.z());
    const Quaternion turn = ExpSo3(Vector3(0, 0, static_cast<double>(flat.turn_rad)));
    candidates.push_back({R_level_map.conjugate() * turn * R_level_imu,
                          earlier.T_map_imu.translation + R_level_map.conjugate() * shift_level});
  }
  if (was_unseen) candidates.push_back(earlier.T_map_imu);
  return candidates;
}

}  // namespace lio
