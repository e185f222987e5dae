// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes uneven, sloping ground with roads that lie lower than it, between kerbs.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lio/sim/paged_mesh.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {

// Gives the height of smooth ground: a slope, hills of 60 to 250 m and bumps of 5 to 15 m.
class Terrain {
 public:
  struct Shape {
    Vector2 slope_ratio = Vector2::Zero();  // rise per metre along x and y
    double hill_m = 0.8;
    double bump_m = 0.015;
  };
  Terrain(const Shape& shape, Random& random);

  [[nodiscard]] double Height(const Vector2& p_m) const;

 private:
  struct Wave {
    Vector2 wave_vector_per_m;
    double amplitude_m = 0.0;
    double phase_rad = 0.0;
  };
  Shape shape_;
  std::vector<Wave> waves_;
};

struct Road {
  std::vector<Vector2> line_m;
  double half_width_m = 4.0;
};

// Gives the distance to the edge of the nearest road, negative on a road. Corners where roads meet
// are rounded with about `rounding_m`.
class RoadNetwork {
 public:
  explicit RoadNetwork(std::vector<Road> roads, double rounding_m = 4.0);

  [[nodiscard]] double SignedDistance(const Vector2& p_m) const;
  const std::vector<Road>& roads() const { return roads_; }

 private:
  // Holds boxes around a road and around pieces of its line, which need no look when they are far.
  struct Boxes {
    Eigen::AlignedBox2d whole;
    std::vector<Eigen::AlignedBox2d> pieces;
  };

  double DistanceToLine(std::size_t road, const Vector2& p_m) const;

  std::vector<Road> roads_;
  std::vector<Boxes> boxes_;  // one per road
  double rounding_m_;
};

struct GroundOptions {
  double cell_m = 1.0;
  double reach_m = 40.0;       // distance beside the roads that the fine mesh covers
  double far_reach_m = 120.0;  // distance that a coarse, slightly lower mesh covers
  double kerb_m = 0.12;        // 0: no kerb
  double pavement_m = 4.0;     // width of the pavement beside the road
  Material road = Material::kAsphalt;
  Material pavement = Material::kPaving;
  Material beyond = Material::kGrass;
};

// Appends the ground to `mesh`: roads lie at the terrain's height, everything else lies a kerb
// higher, and the kerb is a step along the exact edge of the road.
void AddGround(PagedMesh& mesh, const Terrain& terrain, const RoadNetwork& network,
               const GroundOptions& options);

}  // namespace lio::sim
