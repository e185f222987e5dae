// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates a lidar that is carried through a scene: each beam is cast from the pose the
// sensor has at the instant the beam fires, and its echo gets the errors of a real one.
//
// Echoes: a surface of reflectivity rho at incidence angle a and range r returns rho sqrt(cos a) /
// r^2 (rough surfaces fall off slower than Lambert's cosine); polished surfaces add a lobe a few
// degrees wide. The probability of an echo falls from 1 to 0 around the strength that a 10 % target
// has at the range of the model's data file. Range noise grows with incidence and as the echo gets
// weaker. A beam that straddles an edge may return a mixed pixel: seen by sub-rays of its footprint
// (footprint.hpp) or, more simply, guessed from the next column. Random numbers are drawn by (seed,
// column, beam), so that they do not depend on the thread.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"
#include "lio/sim/footprint.hpp"
#include "lio/sim/lidar_model.hpp"
#include "lio/sim/rotor.hpp"
#include "lio/sim/scene.hpp"
#include "lio/sim/trajectory.hpp"

namespace lio::sim {

// Describes a cloud of dust or spray around the sensor for a while.
struct Dust {
  double begin_s = 0.0;
  double end_s = 0.0;
  double echoes_per_m = 0.02;  // probability of an echo from dust per metre of ray
};

struct LidarErrors {
  double noise_scale = 1.0;      // factor on the range noise
  double dropout_ratio = 0.002;  // share of echoes lost at random
  bool has_mixed_pixels = true;
  bool has_footprint = false;  // mixed pixels come from sub-rays, in both directions
  InBetween in_between;
  bool has_glass = false;   // polished surfaces mirror, and glass lets light through
  bool has_relief = false;  // grass, soil and hedges are rough
  double laser_bias_std_m = 0.0;
  double grazing_bias_m = 0.0;  // times 1/cos(incidence) - 1, at most 4 cm
  RangeWalk range_walk;
  double beam_table_std_rad = 0.0;  // errors of each laser's elevation and azimuth
  RotorErrors rotor;
  bool has_weak_echoes = true;  // false: every surface in range returns an echo
  std::vector<Dust> dust;
};

struct LidarSetup {
  LidarModel model;
  Pose T_imu_lidar;
  LidarErrors errors;
  std::uint64_t seed = 1;
  double begin_s = 0.0;  // trajectory time at which sweep 0 begins
};

struct SimulatedSweep {
  std::int64_t begin_ns = 0;  // trajectory time at which t_offset_ns = 0
  std::int64_t num_rays = 0;
  std::vector<LidarPoint> points;     // in the order of firing
  std::vector<EchoKind> kinds;        // how each point came about
  std::vector<float> off_surface_m;   // see Echo::off_surface_m
  std::vector<std::int32_t> objects;  // object that each point lies on: see Hit::object
};

class LidarSimulator {
 public:
  // Keeps references to scene and trajectory, which must outlive the simulator.
  LidarSimulator(LidarSetup setup, const Scene& scene, const Trajectory& trajectory);

  // Returns the turn number `index`, counted from 0. It is safe from several threads.
  [[nodiscard]] SimulatedSweep Sweep(std::int64_t index) const;
  // Returns the trajectory time of that sweep's last firing.
  [[nodiscard]] double SweepEnd_s(std::int64_t index) const;

 private:
  struct Cast;
  [[nodiscard]] Echo GuessStraddling(const Cast& cast, std::size_t index, std::uint64_t key) const;
  [[nodiscard]] Echo EchoOf(const Cast& cast, std::size_t index, std::uint64_t key) const;
  void AddPoint(const Cast& cast, std::int64_t column, std::size_t beam,
                SimulatedSweep& sweep) const;

  LidarSetup setup_;
  const Scene* scene_;
  const Trajectory* trajectory_;
  Rotor rotor_;
  // Each beam has its direction here when the column's heading is 0, true and as the beam table
  // says.
  std::vector<Vector3> column_directions_;
  std::vector<Vector3> table_directions_;
  std::vector<double> laser_bias_m_;
  std::vector<std::size_t> firing_order_;  // beams sorted by firing time
  double weakest_echo_ = 0.0;              // strength at which half of the echoes are lost
};

}  // namespace lio::sim
