// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes an office building of three storeys that look alike: on each a corridor along x between
// rooms, and at its western end a stairwell with two flights from storey to storey. The corridor's
// middle is y = 0, the floor of the lowest storey z = 0. It is used inside src/sim only.
#pragma once

#include "lio/sim/mesh.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {

struct OfficeShape {
  static constexpr int kNumStoreys = 3;
  static constexpr double kStorey_m = 3.3;
  static constexpr double kSlab_m = 0.3;
  static constexpr double kLength_m = 24.0;       // length of the corridor, from x = 0
  static constexpr double kHalfCorridor_m = 0.8;  // it is 1.6 m wide
  static constexpr double kRoomDepth_m = 5.0;
  static constexpr double kWall_m = 0.12;
  static constexpr double kDoorWidth_m = 0.95;
  static constexpr double kDoorHeight_m = 2.05;
  // The walk has these doors, by their middle: one of the lowest storey's northern rooms, one of
  // the highest storey's southern rooms.
  static constexpr double kLowDoor_m = 4.5;
  static constexpr double kHighDoor_m = 6.0;
  // A flight has ten risers and nine treads. The first flight from a storey leads to -x at y < 0 up
  // to the half-landing, the second one back at y > 0.
  static constexpr int kRisers = 10;
  static constexpr double kRiser_m = 0.5 * kStorey_m / kRisers;
  static constexpr double kTread_m = 0.28;
  static constexpr double kLandingEnd_m = -1.8;  // x where a landing ends and flights begin
  static constexpr double kFlight_m = (kRisers - 1) * kTread_m;  // the flight's length along x
  static constexpr double kStairEnd_m = -5.9;                    // x of the stairwell's far wall
  static constexpr double kHalfStair_m = 1.4;
  static constexpr double kHalfGap_m = 0.15;  // half the gap between the flights
};

// Adds the building without the leaves of the walk's two rooms and of the stairwell.
void AddOffice(Mesh& mesh, Random& random);

// A door's leaf, hinged at the origin: it reaches along x and stands on z = 0.
[[nodiscard]] Mesh MakeDoorLeaf();

}  // namespace lio::sim
