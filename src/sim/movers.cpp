// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/movers.hpp"

#include <cmath>
#include <utility>

#include "lio/base/angle.hpp"

namespace lio::sim {

void AddWalker(World& world, Random& random, double speed_mps,
               const std::function<Pose(double t_s)>& body) {
  world.shapes.push_back(MakeTorso(random));
  world.movers.push_back({world.shapes.size() - 1, body});
  world.shapes.push_back(MakeLeg());
  const double phase = random.Uniform(0.0, kTurn_rad);
  for (const double side : {-1.0, 1.0}) {
    const auto leg = [=](double t_s) {
      const double swing = 0.45 * side * std::sin(kTurn_rad * (speed_mps / 1.5) * t_s + phase);
      const Pose T_body_leg{Quaternion(Eigen::AngleAxisd(swing, Vector3::UnitY())),
                            {0.0, 0.1 * side, kHipHeight_m}};
      return body(t_s) * T_body_leg;
    };
    world.movers.push_back({world.shapes.size() - 1, leg});
  }
}

void AddVehicleMover(World& world, VehicleKind kind, Random& random, Path path,
                     std::function<double(double t_s)> distance, HeightFunction height) {
  world.shapes.push_back(MakeVehicle(kind, random));
  const double half_base_m = 0.3 * VehicleSize(kind).x();
  world.movers.push_back(
      {world.shapes.size() - 1, [path = std::move(path), distance = std::move(distance),
                                 height = std::move(height), half_base_m](double t_s) {
         const double along_m = distance(t_s);
         const PathPoint p = path.At(along_m);
         const Vector2 reach = half_base_m * p.Forward();
         const double front = height(p.position_m + reach, along_m + half_base_m);
         const double rear = height(p.position_m - reach, along_m - half_base_m);
         Pose pose =
             UprightPose({p.position_m.x(), p.position_m.y(), 0.5 * (front + rear)}, p.heading_rad);
         const double pitch = -std::atan2(front - rear, 2.0 * half_base_m);
         pose.rotation = pose.rotation * Quaternion(Eigen::AngleAxisd(pitch, Vector3::UnitY()));
         return pose;
       }});
}

}  // namespace lio::sim
