// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the messages between the filter and the registration worker. Each is complete in itself,
// so they may cross threads.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "lio/pipeline/outputs.hpp"
#include "lio/registration/motion_prior.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/place_contest.hpp"
#include "lio/relocalization/search_request.hpp"
#include "lio/relocalization/velocity_search.hpp"
#include "lio/scan/feature_tag.hpp"
#include "lio/scan/loam_features.hpp"
#include "lio/scan/sweep.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// Asks to match the scan near the prior.
struct Track {
  // True betters the prior by correlative alignment of the bird's-eye view with the last located
  // scan's (for a prior of unsure shift).
  bool aligns_prior = false;
  // True holds directions that the match leaves degenerate by the bird's-eye views of earlier
  // scans.
  bool holds_degenerate = false;
};

// Nothing is matched: estimate the velocity from the bird's-eye views of this and of all scans
// since the map was cleared.
struct FindVelocity {};

// Asks to track; where the scan is not found near the prior, to search for it.
struct Relocalize {
  Track track;
  SearchRequest search;
};

enum class MapAction : std::int8_t {
  kKeep,
  kWarmUp,  // this scan is inserted with all its points, as the map is still thin
  kClear,   // forget the map and all earlier scans first; then as kWarmUp
  kEnter,   // from this scan on the map is the initial one
};

struct MatchJob {
  std::shared_ptr<const Sweep> sweep;
  StampedPoses T_any_imu;  // the trajectory over the sweep, in any frame that does not move
  MotionPrior prior;
  MapAction map_action = MapAction::kKeep;
  bool refines_deskew = false;  // match, deskew again along what was found, match again
  // True bends the scan along with the pose that is found, as nothing else measured the motion
  // within it.
  bool bends_scan = false;
  // True matches the scan once more, bent by a turn that nobody has measured, where it lies badly
  // along the trajectory: the gyro may be wrong.
  bool doubts_gyro = false;
  // The extrinsic that trajectory and prior are of. Absent: the rig has it.
  std::optional<Pose> T_imu_lidar = std::nullopt;
  bool seeks_place = false;  // seek the map's place in the initial map besides
  std::variant<Track, FindVelocity, Relocalize> task;
  std::int64_t filter_ns = 0;  // CPU time the filter has spent since the job before
};

struct MatchOutcome {
  std::shared_ptr<const Sweep> sweep;  // the job's
  MatchResult match;
  bool is_relocalized = false;           // located by the search, not near the prior
  bool is_clock_set = false;             // located near SearchRequest::T_map_imu_alternative
  std::optional<Vector3> v_map_imu_mps;  // answers FindVelocity; absent while no velocity is clear
  std::optional<SpeedRange> speed_by_buildings;  // as SeenVelocity, with the same
  std::optional<TurnRate> turn_rate;  // as the sweep itself shows it, with refines_deskew
  std::optional<FoundPlace> place;    // the map's place in the initial map, with seeks_place
  int num_matches = 0;                // full matches of the scan against the map
  int num_coarse_matches = 0;         // the same with a few hundred of its points
  int num_used = 0;                   // points that are matched
  int num_nonfinite = 0;
  bool is_repeated = false;                      // the sweep's points are those of the one before
  std::vector<Eigen::Vector3f> points_imu;       // deskewed, at the sweep's middle
  std::vector<ScanPoint> points_lidar;           // the same as their beams saw them
  std::vector<FeatureTag> tags;                  // one a point; empty where the method needs none
  std::shared_ptr<const LoamFeatures> features;  // the sweep's, where the method has them
  StageTimes stage_ns{};                         // kInsert: of the scan before
};

struct InsertTask {
  std::vector<Eigen::Vector3f> points_imu;
  std::vector<ScanPoint> points_lidar = {};  // the same as their beams saw them; may be empty
  std::optional<Pose> T_map_imu;             // absent: do not insert
  std::vector<FeatureTag> tags = {};         // one a point; empty where the method needs none
};

}  // namespace lio
