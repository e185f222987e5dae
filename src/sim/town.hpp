// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Builds places along roads: rows of houses, trees, lamps, parked cars, and people and cars that
// move. Things are never put where something else stands or where a road runs.
#pragma once

#include <memory>
#include <vector>

#include "lio/sim/random.hpp"
#include "lio/sim/world.hpp"
#include "sim/building.hpp"
#include "sim/drive.hpp"
#include "sim/ground.hpp"
#include "sim/props.hpp"

namespace lio::sim {

// A frontage is a section of one side of a path; the sign of `left` picks the side.
struct Frontage {
  double from_m = 0.0;
  double to_m = 0.0;
  double offset_m = 8.0;  // from the path's middle
  bool on_left = true;
};

struct HouseRow {
  int min_storeys = 3;
  int max_storeys = 8;
  double min_width_m = 10.0;
  double max_width_m = 22.0;
  double depth_m = 12.0;
  double gap_chance = 0.12;  // probability of an alley after a house
  double min_gap_m = 2.0;
  double max_gap_m = 5.0;
  double max_setback_m = 0.8;
  bool has_gable_roofs = false;
  bool has_plain_rear = true;
};

class Town {
 public:
  Town(World& world, Terrain terrain, RoadNetwork roads, const GroundOptions& ground,
       std::uint64_t seed);

  Random& random() { return random_; }
  const Terrain& terrain() const { return terrain_; }
  [[nodiscard]] double GroundHeight(const Vector2& p_m) const;  // kerbs included

  // Puts `mesh` on the ground; `heading_rad` is the direction of its x axis.
  void Place(const Mesh& mesh, const Vector2& p_m, double heading_rad);
  // Returns true, and occupies the rectangle, when it is free of roads (by `road_margin_m`) and of
  // other things.
  bool Reserve(const Vector2& centre_m, double heading_rad, const Vector2& size_m,
               double road_margin_m);

  // Keeps a lane of that width along a path free; call it before anything is put there.
  void KeepClear(const Path& path, double width_m);

  void AddHouses(const Path& path, const Frontage& frontage, const HouseRow& row);
  void AddTrees(const Path& path, const Frontage& frontage, double spacing_m, double height_m);
  void AddLamps(const Path& path, const Frontage& frontage, double spacing_m);
  void AddStreetThings(const Path& path, const Frontage& frontage, double spacing_m);
  // Parks cars along the kerb; `share` of the places are taken.
  void AddParkedCars(const Path& path, const Frontage& frontage, double share);
  void AddHedges(const Path& path, const Frontage& frontage, double share);
  void AddBarrier(const Path& path, const Frontage& frontage, double post_m, double low_m,
                  double high_m, Material material);
  // Paints lines; `gap_m` 0 makes a line without breaks.
  void AddLaneMarks(const Path& path, const Frontage& frontage, double dash_m, double gap_m);
  void AddStandingPeople(const Path& path, const Frontage& frontage, int num);

  // Adds people who walk to and fro between two points of a path, beside it.
  void AddWalkers(const Path& path, const Frontage& frontage, int num);

 private:
  struct Footprint {
    Vector2 centre;
    Vector2 axis;
    Vector2 half;
  };
  [[nodiscard]] static bool Overlaps(const Footprint& a, const Footprint& b);

  World& world_;
  Terrain terrain_;
  RoadNetwork roads_;
  GroundOptions ground_;
  Random random_;
  std::vector<Footprint> taken_;
};

}  // namespace lio::sim
