// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_seeker.hpp"

#include <cmath>
#include <utility>

#include "lio/relocalization/parameters.hpp"
#include "relocalization/standing_points.hpp"

namespace lio {
namespace {

constexpr PlaceSeekerParameters kSeeker = kRelocalization.seeker;

MapSearch::Around RangeAround(const PlaceGuess& guess) {
  const PlanarPose middle{guess.position_m.head<2>().cast<float>(),
                          static_cast<float>(guess.yaw_rad)};
  return {middle, {Eigen::Vector2f::Constant(kSeeker.guess_range_m), kSeeker.guess_range_rad}};
}

}  // namespace

PlaceIndex::PlaceIndex(std::span<const Eigen::Vector3f> points_map)
    : structures(StandingPoints(points_map)), heights(points_map) {}

void PlaceSeeker::Clear() {
  cloud_ = {};
  GiveUp();
  has_sought_ = false;
  num_scans_ = 0;
}

void PlaceSeeker::GiveUp() {
  search_.reset();
  contest_.reset();
}

bool PlaceSeeker::IsSearchDue(const Vector3& position_map) const {
  if (!has_sought_) return num_scans_ >= kSeeker.min_scans;
  return num_scans_ >= kSeeker.again_after_scans ||
         (position_map - sample_.centre_map).norm() > kSeeker.again_after_m;
}

void PlaceSeeker::BeginSearch(const Vector3& position_map) {
  num_scans_ = 0;
  sample_ = cloud_.SampleAround(position_map);
  if (sample_.structures.size() < kSeeker.min_structures) return;
  has_sought_ = true;
  std::optional<MapSearch::Around> around;
  if (guess_) around = RangeAround(*guess_);
  search_.emplace(index_->structures, sample_.structures,
                  sample_.centre_map.head<2>().cast<float>(), around);
}

void PlaceSeeker::BeginContest() {
  std::vector<Eigen::Vector3f> points_map = sample_.points;
  for (Eigen::Vector3f& point : points_map) point += sample_.centre_map.cast<float>();
  std::vector<Pose> places;
  for (const ScoredPlace& place : search_->places()) {
    const Quaternion turn = ExpSo3(Vector3(0, 0, static_cast<double>(place.pose.turn_rad)));
    for (const float height_m : index_->heights.Find(points_map, place.pose)) {
      const Vector3 shift(place.pose.shift_m.x(), place.pose.shift_m.y(), height_m);
      const double off_m = guess_ ? std::abs(shift.z() - guess_->position_m.z()) : 0.0;
      if (off_m <= kSeeker.guess_range_up_m) places.push_back({turn, shift});
    }
  }
  search_.reset();
  contest_.emplace(sample_, places);
  is_ranked_ = false;
}

std::optional<FoundPlace> PlaceSeeker::Add(const LocatedScan& scan,
                                           std::span<const Eigen::Vector3f> all_points_imu,
                                           const PlaceMatching& matching) {
  cloud_.Add(all_points_imu, scan.match.T_map_imu);
  ++num_scans_;
  const Vector3& position_map = scan.match.T_map_imu.translation;
  if (contest_) {
    if (!is_ranked_) {
      is_ranked_ = contest_->Rank(matching.match_coarsely);
      return {};
    }
    const auto found = contest_->Check(scan, matching.match, matching.max_matches);
    if (found || contest_->is_over()) GiveUp();
    return found;
  }
  if (!search_ && IsSearchDue(position_map)) BeginSearch(position_map);
  if (search_ && search_->GoOn(kRelocalization.map_search.max_lookups_per_scan)) BeginContest();
  return {};
}

}  // namespace lio
