// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/initial_map_entry.hpp"

#include <stdexcept>
#include <utility>

#include "lio/relocalization/parameters.hpp"
#include "lio/scan/reduced_scan.hpp"

namespace lio {

InitialMapEntry::InitialMapEntry(const InitialMap& map, std::unique_ptr<ScanMatcher> waiting)
    : index_(map.points), seeker_(index_, map.guess), waiting_(std::move(waiting)) {
  waiting_->SetUp(Vector3::UnitZ());
  if (!waiting_->InsertKept(map.points)) {
    throw std::invalid_argument("InitialMapEntry: the method cannot start in a map");
  }
}

std::optional<FoundPlace> InitialMapEntry::Seek(const LocatedScan& scan,
                                                std::span<const Eigen::Vector3f> all_points_imu,
                                                const Pose& T_imu_lidar, MatchBudget& budget) {
  const auto match = [&](std::span<const Eigen::Vector3f> points, const Pose& guess,
                         const Matrix6& cov) {
    return waiting_->Match({.points_imu = points,
                            .T_map_imu_guess = guess,
                            .guess_cov = cov,
                            .T_imu_lidar = T_imu_lidar,
                            .solves_degenerate = true});
  };
  const PlaceMatching matching{
      [&](std::span<const Eigen::Vector3f> points, const Pose& guess, const Matrix6& cov) {
        return budget.Take() ? match(points, guess, cov) : MatchResult{};
      },
      [&](std::span<const Eigen::Vector3f> points, const Pose& guess, const Matrix6& cov) {
        budget.CountCoarse();
        std::vector<Eigen::Vector3f> few;
        for (const std::uint32_t i :
             SpreadIndices(points.size(), kRelocalization.contest.num_coarse_points)) {
          few.push_back(points[i]);
        }
        return match(few, guess, cov);
      },
      budget.num_left()};
  return seeker_.Add(scan, all_points_imu, matching);
}

void InitialMapEntry::Enter(std::unique_ptr<ScanMatcher>& matcher) {
  if (!is_inside_) std::swap(matcher, waiting_);
  is_inside_ = true;
}

void InitialMapEntry::Leave(std::unique_ptr<ScanMatcher>& matcher) {
  if (is_inside_) std::swap(matcher, waiting_);
  is_inside_ = false;
  seeker_.Clear();
}

}  // namespace lio
