// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Describes a path on the ground, made of straights and arcs, by the distance along it. Vehicles
// and walkers follow such paths, and streets are built along them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace lio::sim {

using Vector2 = Eigen::Vector2d;

struct PathPoint {
  Vector2 position_m = Vector2::Zero();
  double heading_rad = 0.0;      // unwrapped along the path, counter-clockwise from x
  double curvature_per_m = 0.0;  // positive to the left

  [[nodiscard]] Vector2 Forward() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
  [[nodiscard]] Vector2 Left() const { return {-std::sin(heading_rad), std::cos(heading_rad)}; }
};

class Path {
 public:
  Path(const Vector2& start_m, double heading_rad);

  // Makes a path with a corner of the given radius at each inner waypoint. A closed path ends at
  // its start, which must lie on a straight. Throws std::invalid_argument when corners overlap.
  [[nodiscard]] static Path Rounded(const std::vector<Vector2>& waypoints_m, double radius_m,
                                    bool closed);

  // These two append at the end. An arc of positive angle turns left.
  void AddStraight(double length_m);
  void AddArc(double radius_m, double angle_rad);

  double length_m() const { return length_m_; }
  [[nodiscard]] PathPoint At(double distance_m) const;  // continues straight beyond the ends
  // Returns a point beside the path: `left_m` to the left, which must be smaller than the radii.
  [[nodiscard]] PathPoint Beside(double distance_m, double left_m) const;
  // These three return the path between two distances, the path shifted to the left (to the right
  // if negative) by less than its radii, and the path in the opposite direction.
  [[nodiscard]] Path Cut(double from_m, double to_m) const;
  [[nodiscard]] Path Shifted(double left_m) const;
  [[nodiscard]] Path Reversed() const;
  [[nodiscard]] Path Repeated(int times) const;
  // Returns points every `step_m`, both ends included.
  [[nodiscard]] std::vector<Vector2> Sampled(double step_m) const;

 private:
  struct Piece {
    double start_m = 0.0;  // distance along the path at which it begins
    double length_m = 0.0;
    PathPoint begin;
  };
  [[nodiscard]] static PathPoint Along(const Piece& piece, double distance_m);
  void Add(double length_m, double curvature_per_m);

  std::vector<Piece> pieces_;
  PathPoint end_;
  double length_m_ = 0.0;
};

// Gives the height of the ground at a point; `along_m` is the distance along the path that is
// followed, which tells the storeys of a building apart.
using HeightFunction = std::function<double(const Vector2& p_m, double along_m)>;

}  // namespace lio::sim
