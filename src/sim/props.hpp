// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes things that stand, park and move in streets, each a mesh in its own frame: the origin is on
// the ground below its middle, x forward, y left, z up, metres.
#pragma once

#include "lio/sim/mesh.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {

enum class VehicleKind { kCar, kVan, kBus, kTruck };

[[nodiscard]] Mesh MakeVehicle(VehicleKind kind, Random& random);
[[nodiscard]] Vector2 VehicleSize(VehicleKind kind);  // length and width [m]

// A person is made of two parts, so that the legs can swing about the hip at `kHipHeight_m`.
inline constexpr double kHipHeight_m = 0.86;
[[nodiscard]] Mesh MakeTorso(Random& random);
[[nodiscard]] Mesh MakeLeg();                   // origin at the hip, hanging down
[[nodiscard]] Mesh MakePerson(Random& random);  // a standing person in one part

[[nodiscard]] Mesh MakeTree(double height_m,
                            Random& random);  // trunk, boughs and a crown of loose leaves
[[nodiscard]] Mesh MakeBush(const Vector3& size_m, Random& random);
[[nodiscard]] Mesh MakeStreetLamp(double height_m, double arm_m);  // arm toward +x
[[nodiscard]] Mesh MakeSign(double height_m, Random& random);      // faces +x
[[nodiscard]] Mesh MakeBollard();
[[nodiscard]] Mesh MakeBin();
[[nodiscard]] Mesh MakeBench();
[[nodiscard]] Mesh MakeBusShelter();  // open toward +x

}  // namespace lio::sim
