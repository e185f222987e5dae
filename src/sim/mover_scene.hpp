// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Poses what moves over an interval of time, ready to cast into.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "lio/sim/world.hpp"
#include "sim/embree.hpp"

namespace lio::sim {

// The instances have the numbers of the movers.
struct MoverScene {
  ScenePtr scene;                      // null when nothing moves within reach
  std::vector<Matrix3> R_mover_world;  // one per mover, at the interval's middle
};

class MoverScenes {
 public:
  // `world` and `device` must outlive it.
  MoverScenes(const World& world, double reach_m, RTCDevice device);

  // Returns the movers that come within reach of `place_m` (world) in the interval. Safe from any
  // thread.
  [[nodiscard]] MoverScene During(double begin_s, double end_s, const Vector3& place_m);

  // Shapes that are kept ready. Not while another thread calls During.
  [[nodiscard]] std::size_t num_shapes() const { return shapes_.size(); }

 private:
  struct Shape {
    ScenePtr scene;
    std::int64_t last_interval = 0;
  };

  void BeginInterval();
  void SetShape(std::size_t shape, RTCGeometry instance);

  const World& world_;
  double reach_m_;
  RTCDevice device_;
  std::vector<double> radii_m_;  // one per shape, about its origin
  std::mutex mutex_;             // guards what follows
  std::map<std::size_t, Shape> shapes_;
  std::int64_t num_intervals_ = 0;
};

}  // namespace lio::sim
