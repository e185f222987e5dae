// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "office_building.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "sim/unturned_pose.hpp"

namespace lio::sim {
namespace {

using Shape = OfficeShape;

constexpr double kClear_m = Shape::kStorey_m - Shape::kSlab_m;
constexpr double kOuterWall_m = 0.3;
constexpr double kStairWall_m = 0.2;
constexpr double kHalfStairDoor_m = 0.5 * Shape::kDoorWidth_m;
constexpr double kRoomWall_m = Shape::kHalfCorridor_m + 0.5 * Shape::kWall_m;  // |y| of its middle
constexpr double kRoomFar_m = Shape::kHalfCorridor_m + Shape::kWall_m + Shape::kRoomDepth_m;
constexpr double kOuter_m = kRoomFar_m + 0.5 * kOuterWall_m;
constexpr double kRoof_m = Shape::kNumStoreys * Shape::kStorey_m;

// Holds the rooms of one side of the corridor, by their doors and their walls to the east.
struct Rooms {
  double side;  // +1: north
  std::array<double, 4> doors_m;
  std::array<double, 4> ends_m;
};
constexpr std::array<Rooms, 2> kRooms = {{
    {1.0, {Shape::kLowDoor_m, 10.5, 16.5, 22.0}, {7.5, 13.5, 19.5, Shape::kLength_m}},
    {-1.0, {Shape::kHighDoor_m, 12.0, 18.0, 22.5}, {9.0, 15.0, 21.0, Shape::kLength_m}},
}};

// Holds an opening in a wall: its extent along the wall and its height.
struct Opening {
  double from = 0.0;
  double to = 0.0;
  double low = 0.0;
  double high = Shape::kDoorHeight_m;
};

struct Wall {
  Vector2 from;
  Vector2 to;
  double z = 0.0;
  double height_m = kClear_m;
  double thickness_m = Shape::kWall_m;
  Material material = Material::kPlaster;
};

void AddPiece(Mesh& mesh, const Wall& wall, const Opening& piece, double thickness_m,
              Material material) {
  if (piece.to - piece.from < 1e-6 || piece.high - piece.low < 1e-6) return;
  const Vector2 along = (wall.to - wall.from).normalized();
  const Vector2 middle = wall.from + 0.5 * (piece.from + piece.to) * along;
  AddBox(
      mesh,
      UprightPose({middle.x(), middle.y(), wall.z + piece.low}, std::atan2(along.y(), along.x())),
      {piece.to - piece.from, thickness_m, piece.high - piece.low}, material);
}

// Adds a wall with openings, in order along it; those that do not begin at the floor have a pane.
void AddWall(Mesh& mesh, const Wall& wall, std::span<const Opening> openings) {
  constexpr double kPane_m = 0.02;
  double reached = 0.0;
  for (const Opening& hole : openings) {
    AddPiece(mesh, wall, {reached, hole.from, 0.0, wall.height_m}, wall.thickness_m, wall.material);
    AddPiece(mesh, wall, {hole.from, hole.to, 0.0, hole.low}, wall.thickness_m, wall.material);
    AddPiece(mesh, wall, {hole.from, hole.to, hole.high, wall.height_m}, wall.thickness_m,
             wall.material);
    if (hole.low > 0.0) AddPiece(mesh, wall, hole, kPane_m, Material::kGlass);
    reached = hole.to;
  }
  AddPiece(mesh, wall, {reached, (wall.to - wall.from).norm(), 0.0, wall.height_m},
           wall.thickness_m, wall.material);
}

// Adds the leaf of a door that nobody walks through: every third one stands open.
void AddLeaf(Mesh& mesh, const Rooms& rooms, std::size_t index, double z) {
  const double hinge_m = rooms.doors_m[index] - 0.5 * Shape::kDoorWidth_m;
  const double heading = index % 3 == 1 ? rooms.side * 0.55 * std::numbers::pi : 0.0;
  AddMesh(mesh, MakeDoorLeaf(), UprightPose({hinge_m, rooms.side * kRoomWall_m, z}, heading));
}

bool IsOnTheWalk(const Rooms& rooms, std::size_t index, int storey) {
  return index == 0 && storey == (rooms.side > 0.0 ? 0 : Shape::kNumStoreys - 1);
}

void AddCorridor(Mesh& mesh, int storey) {
  const double z = Shape::kStorey_m * storey;
  for (const Rooms& rooms : kRooms) {
    std::array<Opening, 4> doors;
    for (std::size_t i = 0; i < doors.size(); ++i) {
      const double middle_m = rooms.doors_m[i];
      doors[i] = {middle_m - 0.5 * Shape::kDoorWidth_m, middle_m + 0.5 * Shape::kDoorWidth_m};
      if (!IsOnTheWalk(rooms, i, storey)) AddLeaf(mesh, rooms, i, z);
    }
    const double y = rooms.side * kRoomWall_m;
    AddWall(mesh, {{0.0, y}, {Shape::kLength_m, y}, z}, doors);
  }
  for (double x = 2.0; x < Shape::kLength_m; x += 4.0) {  // lamps
    AddBox(mesh, At(x, 0.0, z + kClear_m - 0.08), {1.2, 0.25, 0.08}, Material::kPlaster);
  }
  for (double x = 3.0; x < Shape::kLength_m; x += 9.0) {  // fire extinguishers, boards
    AddBar(mesh, {x, -Shape::kHalfCorridor_m + 0.1, z + 0.5},
           {x, -Shape::kHalfCorridor_m + 0.1, z + 1.05}, 0.08, 0.08, 10, Material::kCarPaintRed);
    AddBox(mesh, At(x - 0.2, Shape::kHalfCorridor_m - 0.02, z + 1.1), {1.4, 0.04, 0.9},
           Material::kCloth);
  }
}

void AddDesk(Mesh& mesh, const Pose& desk, Random& random) {
  Mesh part;
  AddBox(part, At(0, 0, 0.71), {1.6, 0.8, 0.03}, Material::kWood);
  for (const double x : {-0.75, 0.75})
    AddBox(part, At(x, 0, 0), {0.04, 0.7, 0.71}, Material::kMetal);
  AddBox(part, At(random.Uniform(-0.3, 0.3), 0.2, 0.84), {0.6, 0.04, 0.36}, Material::kDarkMetal);
  AddBar(part, {0, 0.2, 0.74}, {0, 0.2, 0.9}, 0.03, 0.03, 6, Material::kDarkMetal);
  const double chair = random.Uniform(-0.4, 0.4);
  AddBox(part, At(chair, -0.6, 0.45), {0.48, 0.48, 0.08}, Material::kCloth);
  AddBox(part, At(chair, -0.82, 0.55), {0.46, 0.06, 0.5}, Material::kCloth);
  AddBar(part, {chair, -0.6, 0.0}, {chair, -0.6, 0.45}, 0.04, 0.04, 6, Material::kMetal);
  AddMesh(mesh, part, desk);
}

// Furnishes a room along its outer and its inner wall; the middle, where the walk goes, stays free.
void AddFurniture(Mesh& mesh, const Rooms& rooms, std::size_t index, double z, Random& random) {
  const double begin_m = (index == 0 ? 0.0 : rooms.ends_m[index - 1]) + 0.3;
  const double end_m = rooms.ends_m[index] - 0.3;
  const double heading = rooms.side > 0.0 ? 0.0 : std::numbers::pi;
  for (double x = begin_m + 0.9; x + 0.9 < end_m; x += random.Uniform(1.8, 2.6)) {
    AddDesk(mesh, UprightPose({x, rooms.side * (kRoomFar_m - 0.55), z}, heading), random);
  }
  for (double x = begin_m + 0.4; x + 0.4 < end_m; x += 0.82) {  // shelves
    const double height_m = random.Uniform(0.8, 2.0);
    const bool is_free = random.Chance(0.5) || std::abs(x - rooms.doors_m[index]) < 1.6;
    if (is_free) continue;
    AddBox(mesh, At(x, rooms.side * (kRoomWall_m + 0.26), z), {0.8, 0.38, height_m},
           random.Chance(0.5) ? Material::kWood : Material::kMetal);
  }
}

void AddRooms(Mesh& mesh, int storey, Random& random) {
  const double z = Shape::kStorey_m * storey;
  for (const Rooms& rooms : kRooms) {
    std::array<Opening, 8> windows;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const double x = 1.5 + 3.0 * static_cast<double>(i);
      windows[i] = {x - 0.7, x + 0.7, 0.9, 2.3};
      AddBox(mesh, At(x, rooms.side * (kRoomFar_m - 0.06), z + 0.12), {1.2, 0.1, 0.55},
             Material::kMetal);  // the radiator
    }
    const double y = rooms.side * kOuter_m;
    AddWall(mesh, {{0.0, y}, {Shape::kLength_m, y}, z, kClear_m, kOuterWall_m, Material::kBrick},
            windows);
    for (std::size_t i = 0; i < rooms.ends_m.size(); ++i) {
      const double x = rooms.ends_m[i];
      const double inner = rooms.side * (Shape::kHalfCorridor_m + Shape::kWall_m);
      if (i + 1 < rooms.ends_m.size())
        AddWall(mesh, {{x, inner}, {x, rooms.side * kRoomFar_m}, z}, {});
      AddFurniture(mesh, rooms, i, z, random);
    }
  }
  const double east_m = Shape::kLength_m + 0.5 * kOuterWall_m;
  const Opening window{kOuter_m - 0.5, kOuter_m + 0.5, 0.9, 2.3};
  AddWall(mesh,
          {{east_m, -kOuter_m}, {east_m, kOuter_m}, z, kClear_m, kOuterWall_m, Material::kBrick},
          {&window, 1});
  const double west_m = -0.5 * kStairWall_m;
  const Opening door{kOuter_m - kHalfStairDoor_m, kOuter_m + kHalfStairDoor_m};
  AddWall(mesh, {{west_m, -kOuter_m}, {west_m, kOuter_m}, z, kClear_m, kStairWall_m}, {&door, 1});
}

// Adds the slab below the storey's floor, which for the number of storeys is the roof.
void AddSlab(Mesh& mesh, int storey) {
  const double z = Shape::kStorey_m * storey - Shape::kSlab_m;
  const bool is_whole = storey == 0 || storey == Shape::kNumStoreys;
  const double from_m = is_whole ? Shape::kStairEnd_m - kStairWall_m : -kStairWall_m;
  const double to_m = Shape::kLength_m + kOuterWall_m;
  AddBox(mesh, At(0.5 * (from_m + to_m), 0.0, z),
         {to_m - from_m, 2.0 * kOuter_m + kOuterWall_m, Shape::kSlab_m}, Material::kConcrete);
}

// A flight of stairs leads from (x, z) along `direction` (+1: to +x) at |y| between gap and wall.
struct Flight {
  double x = 0.0;
  double z = 0.0;
  double direction = 1.0;
  double side = 1.0;  // sign of y
};

void AddFlight(Mesh& mesh, const Flight& flight) {
  constexpr double kThickness_m = 0.18;
  constexpr Material kStone = Material::kConcrete;
  const double near_m = flight.side * Shape::kHalfGap_m;
  const double far_m = flight.side * Shape::kHalfStair_m;
  const auto at = [&](double tread, double y, double up) {
    return Vector3(flight.x + flight.direction * Shape::kTread_m * tread, y,
                   flight.z + Shape::kRiser_m * up);
  };
  constexpr double kBelow = kThickness_m / Shape::kRiser_m;
  for (int i = 0; i < Shape::kRisers; ++i) {
    AddQuad(mesh, at(i, near_m, i), at(i, far_m, i), at(i, far_m, i + 1), at(i, near_m, i + 1),
            kStone);
    if (i + 1 == Shape::kRisers) break;
    AddQuad(mesh, at(i, near_m, i + 1), at(i, far_m, i + 1), at(i + 1, far_m, i + 1),
            at(i + 1, near_m, i + 1), kStone);
    AddQuad(mesh, at(i, near_m, i - kBelow), at(i + 1, near_m, i + 1 - kBelow),
            at(i + 1, near_m, i + 1), at(i, near_m, i + 1), kStone);
    if (i % 2 == 0)
      AddBar(mesh, at(i, near_m, i + 1), at(i, near_m, i + 6.4), 0.012, 0.012, 5, Material::kMetal);
  }
  constexpr int kLast = Shape::kRisers - 1;
  AddQuad(mesh, at(0, near_m, -kBelow), at(0, far_m, -kBelow), at(kLast, far_m, kLast - kBelow),
          at(kLast, near_m, kLast - kBelow), kStone);
  AddBar(mesh, at(0, near_m, 6.4), at(kLast, near_m, kLast + 6.4), 0.025, 0.025, 8,
         Material::kMetal);
  AddBar(mesh, at(0, far_m - 0.07 * flight.side, 6.0),
         at(kLast, far_m - 0.07 * flight.side, kLast + 6.0), 0.022, 0.022, 8, Material::kWood);
}

// Adds the slab that a flight ends on, and below it nothing: it stands out of the walls.
void AddLanding(Mesh& mesh, double from_m, double to_m, double z) {
  constexpr double kThickness_m = 0.2;
  AddBox(mesh, At(0.5 * (from_m + to_m), 0.0, z - kThickness_m),
         {std::abs(to_m - from_m), 2.0 * Shape::kHalfStair_m, kThickness_m}, Material::kConcrete);
}

void AddStairwell(Mesh& mesh) {
  constexpr double kFlightEnd_m = Shape::kLandingEnd_m - Shape::kFlight_m;
  const double side_m = Shape::kHalfStair_m + 0.5 * kStairWall_m;
  for (const double y : {-side_m, side_m}) {
    AddWall(
        mesh,
        {{Shape::kStairEnd_m, y}, {-kStairWall_m, y}, 0.0, kRoof_m - Shape::kSlab_m, kStairWall_m},
        {});
  }
  for (int storey = 0; storey < Shape::kNumStoreys; ++storey) {
    const double z = Shape::kStorey_m * storey;
    const double x = Shape::kStairEnd_m - 0.5 * kStairWall_m;
    const Opening window{side_m - 0.5, side_m + 0.5, 1.5, 2.7};  // above the half-landing
    const bool is_top = storey + 1 == Shape::kNumStoreys;
    AddWall(mesh,
            {{x, -side_m},
             {x, side_m},
             z + 1.0,
             is_top ? kClear_m - 1.0 : Shape::kStorey_m,
             kStairWall_m},
            {&window, is_top ? 0u : 1u});
    if (storey > 0) AddLanding(mesh, Shape::kLandingEnd_m, -kStairWall_m, z);
    if (is_top) break;
    const double half_m = z + 0.5 * Shape::kStorey_m;
    AddFlight(mesh, {Shape::kLandingEnd_m, z, -1.0, -1.0});
    AddFlight(mesh, {kFlightEnd_m, half_m, 1.0, 1.0});
    AddLanding(mesh, Shape::kStairEnd_m, kFlightEnd_m, half_m);
  }
  AddPiece(mesh,
           {{Shape::kStairEnd_m - 0.5 * kStairWall_m, -side_m},
            {Shape::kStairEnd_m - 0.5 * kStairWall_m, side_m}},
           {0.0, 2.0 * side_m, 0.0, 1.0}, kStairWall_m, Material::kPlaster);
  const double top_m = kRoof_m - Shape::kStorey_m;  // the guard where no flight leads up any more
  for (const double up : {0.15, 0.55, 1.0}) {
    AddBar(mesh, {Shape::kLandingEnd_m, -Shape::kHalfStair_m, top_m + up},
           {Shape::kLandingEnd_m, -Shape::kHalfGap_m, top_m + up}, 0.025, 0.025, 8,
           Material::kMetal);
  }
}

}  // namespace

void AddOffice(Mesh& mesh, Random& random) {
  for (int storey = 0; storey < Shape::kNumStoreys; ++storey) {
    AddSlab(mesh, storey);
    AddCorridor(mesh, storey);
    AddRooms(mesh, storey, random);
  }
  AddSlab(mesh, Shape::kNumStoreys);
  AddStairwell(mesh);
}

Mesh MakeDoorLeaf() {
  Mesh leaf;
  AddBox(leaf, At(0.5 * Shape::kDoorWidth_m, 0.0, 0.01),
         {Shape::kDoorWidth_m - 0.02, 0.04, Shape::kDoorHeight_m - 0.02}, Material::kWood);
  for (const double side : {-1.0, 1.0}) {  // the handles
    AddBar(leaf, {Shape::kDoorWidth_m - 0.2, 0.06 * side, 1.05},
           {Shape::kDoorWidth_m - 0.08, 0.06 * side, 1.05}, 0.012, 0.012, 6, Material::kMetal);
  }
  return leaf;
}

}  // namespace lio::sim
