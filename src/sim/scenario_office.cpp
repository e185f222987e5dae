// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the office: a walk with a hand-held sensor out of a room, along a narrow corridor, up four
// flights of stairs into a room two storeys higher, and back.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "carrier.hpp"
#include "office_building.hpp"
#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

using Shape = OfficeShape;

constexpr double kStairLane_m = 0.7;  // |y| of the walk on the stairs
constexpr double kCorner_m = 0.6;

// Returns the way from the room below to the middle of the room above.
std::vector<Vector2> WayUp() {
  constexpr double kTurn_m = -5.0;  // x of the turns on half-landings
  std::vector<Vector2> way = {{6.6, 3.0},
                              {Shape::kLowDoor_m, 3.0},
                              {Shape::kLowDoor_m, 0.0},
                              {0.2, 0.0},
                              {-1.6, -kStairLane_m}};
  for (int storey = 0; storey + 1 < Shape::kNumStoreys; ++storey) {
    if (storey > 0) way.insert(way.end(), {{-1.0, kStairLane_m}, {-1.0, -kStairLane_m}});
    way.insert(way.end(), {{kTurn_m, -kStairLane_m}, {kTurn_m, kStairLane_m}});
  }
  way.insert(way.end(), {{-1.6, kStairLane_m}, {0.2, 0.0}, {Shape::kHighDoor_m, 0.0}});
  return way;
}

Path Way() {
  constexpr double x = Shape::kHighDoor_m;
  const std::vector<Vector2> up = WayUp();
  std::vector<Vector2> way = up;
  way.insert(way.end(), {{x, -3.8}, {x + 1.9, -3.8}, {x + 1.9, -2.2}, {x, -2.2}});
  way.insert(way.end(), up.rbegin(), up.rend());
  return Path::Rounded(way, kCorner_m, false);
}

// Holds the height of the floor and the passages of doors along the way.
class Floor {
 public:
  explicit Floor(const Path& way) {
    const double turns_m = 0.5 * way.length_m();  // in the room above
    double climbed = ClimbedShare(way.At(0.0).position_m.x());
    Place place = PlaceOf(way.At(0.0).position_m);
    for (double along_m = 0.0; along_m <= way.length_m(); along_m += kStep_m) {
      const Vector2 at = way.At(along_m).position_m;
      const double share = ClimbedShare(at.x());
      const double rise_m = 0.5 * Shape::kStorey_m * std::abs(share - climbed);
      climbed = share;
      const double z = heights_m_.empty() ? 0.0 : heights_m_.back();
      heights_m_.push_back(z + (along_m < turns_m ? rise_m : -rise_m));
      if (PlaceOf(at) != place) doors_m_.push_back(along_m);
      place = PlaceOf(at);
    }
  }

  double HeightAt(double along_m) const {
    const double x = std::clamp(along_m / kStep_m, 0.0, static_cast<double>(heights_m_.size() - 2));
    const auto i = static_cast<std::size_t>(x);
    return std::lerp(heights_m_[i], heights_m_[i + 1], x - static_cast<double>(i));
  }
  // How far the walker still is from the passage, or is past it; doors are numbered along the way.
  double FromDoor(std::size_t door, double along_m) const {
    return std::abs(doors_m_.at(door) - along_m);
  }

 private:
  static constexpr double kStep_m = 0.02;
  // Returns the share of a flight that lies below the way at x.
  static double ClimbedShare(double x) {
    return std::clamp((Shape::kLandingEnd_m - x) / Shape::kFlight_m, 0.0, 1.0);
  }
  enum class Place { kRoom, kCorridor, kStairwell };
  static Place PlaceOf(const Vector2& at) {
    if (at.x() < 0.0) return Place::kStairwell;
    const bool is_in_room = std::abs(at.y()) > Shape::kHalfCorridor_m + 0.5 * Shape::kWall_m;
    return is_in_room ? Place::kRoom : Place::kCorridor;
  }

  std::vector<double> heights_m_;
  std::vector<double> doors_m_;
};

// A door opens before the walker comes and closes behind him.
struct Door {
  Pose T_world_closed;
  double opened_rad = 0.0;                // turn about the hinge
  std::array<std::size_t, 2> passages{};  // on the way there and back
};

void AddDoor(World& world, const Door& door, const std::shared_ptr<const Drive>& drive,
             const std::shared_ptr<const Floor>& floor) {
  world.shapes.push_back(MakeDoorLeaf());
  world.movers.push_back(
      {world.shapes.size() - 1, [=](double t_s) {
         constexpr double kOpens_m = 2.6;
         constexpr double kIsOpen_m = 1.4;
         const double along_m = drive->DistanceAt(t_s);
         const double away_m = std::min(floor->FromDoor(door.passages[0], along_m),
                                        floor->FromDoor(door.passages[1], along_m));
         const double open = std::clamp((kOpens_m - away_m) / (kOpens_m - kIsOpen_m), 0.0, 1.0);
         const double eased = open * open * (3.0 - 2.0 * open);
         return door.T_world_closed * UprightPose(Vector3::Zero(), door.opened_rad * eased);
       }});
}

// Rooms' doors open into the rooms, the stairwell's into the corridor. The stairwell's door on the
// storey between stays shut.
void AddDoors(World& world, const std::shared_ptr<const Drive>& drive,
              const std::shared_ptr<const Floor>& floor) {
  constexpr double y = Shape::kHalfCorridor_m + 0.5 * Shape::kWall_m;
  constexpr double kTop_m = (Shape::kNumStoreys - 1) * Shape::kStorey_m;
  constexpr double kHalf_m = 0.5 * Shape::kDoorWidth_m;
  constexpr double kRoomOpen_rad = 0.56 * std::numbers::pi;
  constexpr double kStairOpen_rad = 0.5 * std::numbers::pi;
  const auto stair_door = [=](double z) {
    return UprightPose({0.0, kHalf_m, z}, -0.5 * std::numbers::pi);
  };
  AddDoor(world, {UprightPose({Shape::kLowDoor_m - kHalf_m, y, 0.0}, 0.0), kRoomOpen_rad, {0, 7}},
          drive, floor);
  AddDoor(world, {stair_door(0.0), kStairOpen_rad, {1, 6}}, drive, floor);
  AddDoor(world, {stair_door(kTop_m), kStairOpen_rad, {2, 5}}, drive, floor);
  AddDoor(world,
          {UprightPose({Shape::kHighDoor_m - kHalf_m, -y, kTop_m}, 0.0), -kRoomOpen_rad, {3, 4}},
          drive, floor);
  AddMesh(world.fixed.page(), MakeDoorLeaf(), stair_door(Shape::kStorey_m));
}

}  // namespace

Scenario MakeOffice(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(108.0);
  const double planned_s = PlannedSeconds(scenario, options);
  Random random(options.seed, Purpose::kWorld, 12);
  AddOffice(scenario.world.fixed.page(), random);

  const Path way = Way();
  DriveLimits limits;
  limits.speed_mps = 1.0;
  limits.accel_mps2 = 0.7;
  limits.brake_mps2 = 0.9;
  limits.lateral_mps2 = 0.5;
  const auto drive = std::make_shared<const Drive>(way, limits, std::vector<Stop>{}, kStartRest_s);
  const auto floor = std::make_shared<const Floor>(way);
  AddDoors(scenario.world, drive, floor);
  BodyResponse response;
  response.lean_rad_per_mps2 = 0.0;
  response.dive_rad_per_mps2 = 0.01;
  response.half_wheelbase_m = 0.0;
  response.lively_speed_mps = 0.9;
  MotionPlan plan;
  plan.knot_interval_s = kCarrierKnot_s;
  plan.knots = FollowDrive(
      way, *drive, [&](const Vector2&, double along_m) { return floor->HeightAt(along_m); },
      response, kCarrierKnot_s, planned_s);
  Random motion(options.seed, Purpose::kMotion, 4);
  AddGlances(plan.knots, kCarrierKnot_s, 1.2, motion);
  plan.oscillations = WalkOscillations(options.seed);
  MountOnPerson(scenario, std::move(plan));
  scenario.lidar_model = "vlp16";
  scenario.ceiling_m = 1.0;
  SetBegin(scenario, options, 0.6);
  return scenario;
}

}  // namespace lio::sim
