// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_seeker.hpp"

#include <cmath>
#include <utility>

#include "lio/relocalization/candidate.hpp"
#include "lio/relocalization/parameters.hpp"
#include "relocalization/standing_points.hpp"

namespace lio {
namespace {

constexpr PlaceSeekerParameters kSeeker = kRelocalization.seeker;

MapSearch::Around RangeAround(const PlaceGuess& guess) {
  const PlanarPose middle{guess.position_m.head<2>().cast<float>(),
                          static_cast<float>(guess.yaw_rad)};
  return {middle,
          {Eigen::Vector2f::Constant(kSeeker.guess_range_m), kSeeker.guess_range_rad},
          static_cast<float>(guess.position_m.z()),
          kSeeker.guess_range_up_m};
}

}  // namespace

PlaceIndex::PlaceIndex(std::span<const Eigen::Vector3f> points_map)
    : structures(StructurePyramid::IsOfBuilding(points_map)
                     ? StructurePyramid::InBuilding(points_map)
                     : StructurePyramid::FromAbove(StandingPoints(points_map))) {
  if (structures.is_flat()) heights.emplace(points_map);
}

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

std::vector<Eigen::Vector3f> PlaceSeeker::Sought() const {
  std::vector<Eigen::Vector3f> sought;
  if (index_->structures.is_flat()) {
    for (const Eigen::Vector2f& thing : sample_.structures) {
      sought.emplace_back(thing.x(), thing.y(), 0.f);
    }
    return sought;
  }
  const MapSearchScale& scale = index_->structures.scale();
  std::vector<Eigen::Vector3f> near;
  for (const Eigen::Vector3f& point : sample_.points) {
    if (point.norm() < scale.max_range_m) near.push_back(point);
  }
  const Eigen::Vector3f centre = sample_.centre_map.cast<float>();
  for (const std::uint32_t i : SpreadIndices(near.size(), static_cast<int>(scale.max_num))) {
    sought.emplace_back(near[i] + centre);
  }
  return sought;
}

void PlaceSeeker::BeginSearch(const Vector3& position_map) {
  num_scans_ = 0;
  sample_ = cloud_.SampleAround(position_map);
  const std::vector<Eigen::Vector3f> sought = Sought();
  if (sought.size() < kSeeker.min_structures) return;
  has_sought_ = true;
  std::optional<MapSearch::Around> around;
  if (guess_) around = RangeAround(*guess_);
  Eigen::Vector3f centre = sample_.centre_map.cast<float>();
  if (index_->structures.is_flat()) centre.z() = 0.f;
  search_.emplace(index_->structures, sought, centre, around);
}

std::vector<Pose> PlaceSeeker::PlacesOf(const ScoredPlace& found,
                                        std::span<const Eigen::Vector3f> points_map) const {
  const std::vector<float> heights_m =
      index_->heights ? index_->heights->Find(points_map, found.pose) : std::vector{found.height_m};
  const Quaternion turn = ExpSo3(Vector3(0, 0, static_cast<double>(found.pose.turn_rad)));
  std::vector<Pose> places;
  for (const float height_m : heights_m) {
    const Vector3 shift(found.pose.shift_m.x(), found.pose.shift_m.y(), height_m);
    const double off_m = guess_ ? std::abs(shift.z() - guess_->position_m.z()) : 0.0;
    if (off_m <= kSeeker.guess_range_up_m) places.push_back({turn, shift});
  }
  return places;
}

void PlaceSeeker::BeginContest() {
  std::vector<Eigen::Vector3f> points_map = sample_.points;
  for (Eigen::Vector3f& point : points_map) point += sample_.centre_map.cast<float>();
  std::vector<Pose> places;
  for (const ScoredPlace& found : search_->places()) {
    for (const Pose& place : PlacesOf(found, points_map)) places.push_back(place);
  }
  const MapSearchScale& scale = index_->structures.scale();
  search_.reset();
  contest_.emplace(sample_, places, CandidateCov(scale.std_m, scale.std_rad));
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
