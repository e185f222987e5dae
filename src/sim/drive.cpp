// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

constexpr double kGrid_m = 0.25;    // largest step of the speed profile along the path
constexpr double kSample_s = 0.02;  // time step of the sampled distance

void CheckLimits(const DriveLimits& limits) {
  const double least =
      std::min({limits.speed_mps, limits.accel_mps2, limits.brake_mps2, limits.lateral_mps2});
  if (!(least > 0.0)) throw std::invalid_argument("Drive: every limit must be positive");
}

// Divides the path into equal cells, so that the last one leaves as much room to brake as any
// other.
struct Grid {
  std::size_t num_points = 0;
  double cell_m = 0.0;

  explicit Grid(double length_m)
      : num_points(static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / kGrid_m))) + 1),
        cell_m(length_m / static_cast<double>(num_points - 1)) {}
  std::size_t At(double distance_m) const {
    return std::min(num_points - 1, static_cast<std::size_t>(std::lround(distance_m / cell_m)));
  }
};

// Returns the highest speed at each grid point: first bends and stops limit it, then braking and
// accelerating.
std::vector<double> SpeedProfile(const Path& path, const DriveLimits& limits,
                                 const std::vector<Stop>& stops, const Grid& grid) {
  const std::size_t num = grid.num_points;
  std::vector<double> speed(num, limits.speed_mps);
  for (std::size_t i = 0; i < num; ++i) {
    const double curvature =
        std::abs(path.At(static_cast<double>(i) * grid.cell_m).curvature_per_m);
    if (curvature > 0.0) speed[i] = std::min(speed[i], std::sqrt(limits.lateral_mps2 / curvature));
  }
  speed.front() = 0.0;
  speed.back() = 0.0;
  for (const Stop& stop : stops) {
    speed[grid.At(stop.distance_m)] = 0.0;
  }
  for (std::size_t i = 1; i < num; ++i) {
    speed[i] = std::min(
        speed[i], std::sqrt(speed[i - 1] * speed[i - 1] + 2.0 * limits.accel_mps2 * grid.cell_m));
  }
  for (std::size_t i = num - 1; i-- > 0;) {
    speed[i] = std::min(
        speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + 2.0 * limits.brake_mps2 * grid.cell_m));
  }
  return speed;
}

double RestAt(const std::vector<Stop>& stops, const Grid& grid, std::size_t grid_index) {
  double rest_s = 0.0;
  for (const Stop& stop : stops) {
    if (grid.At(stop.distance_m) == grid_index) rest_s += stop.rest_s;
  }
  return rest_s;
}

}  // namespace

Drive::Drive(const Path& path, const DriveLimits& limits, const std::vector<Stop>& stops,
             double start_rest_s) {
  CheckLimits(limits);
  const Grid grid(path.length_m());
  const std::vector<double> speed = SpeedProfile(path, limits, stops, grid);
  double leg_start_s = start_rest_s;  // time at which grid point i is left
  double next_sample_s = 0.0;
  while (next_sample_s <= leg_start_s) {
    distances_m_.push_back(0.0);
    next_sample_s = kSample_s * static_cast<double>(distances_m_.size());
  }
  for (std::size_t i = 0; i + 1 < speed.size(); ++i) {
    const double from_m = static_cast<double>(i) * grid.cell_m;
    const double mean_mps = 0.5 * (speed[i] + speed[i + 1]);
    const double leg_s = grid.cell_m / mean_mps;
    const double accel_mps2 = (speed[i + 1] - speed[i]) / leg_s;
    const double rest_s = RestAt(stops, grid, i + 1);
    while (next_sample_s <= leg_start_s + leg_s + rest_s) {
      const double dt = std::min(next_sample_s - leg_start_s, leg_s);
      distances_m_.push_back(from_m + speed[i] * dt + 0.5 * accel_mps2 * dt * dt);
      next_sample_s = kSample_s * static_cast<double>(distances_m_.size());
    }
    leg_start_s += leg_s + rest_s;
  }
  distances_m_.push_back(path.length_m());
}

double Drive::duration_s() const {
  return kSample_s * static_cast<double>(distances_m_.size() - 1);
}

double Drive::DistanceAt(double t_s) const {
  const double x = std::clamp(t_s / kSample_s, 0.0, static_cast<double>(distances_m_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), distances_m_.size() - 2);
  const double fraction = x - static_cast<double>(i);
  return distances_m_[i] + fraction * (distances_m_[i + 1] - distances_m_[i]);
}

std::vector<BodyKnot> FollowDrive(const Path& path, const Drive& drive,
                                  const HeightFunction& height, const BodyResponse& response,
                                  double knot_interval_s, double duration_s) {
  const double h = knot_interval_s;
  const auto num = static_cast<int>(std::ceil(duration_s / h)) + 8;
  std::vector<BodyKnot> knots;
  knots.reserve(static_cast<std::size_t>(num));
  for (int i = 0; i < num; ++i) {
    const double t_s = h * i;
    const double distance_m = drive.DistanceAt(t_s);
    const double ahead_m = drive.DistanceAt(t_s + h) - distance_m;
    const double behind_m = distance_m - drive.DistanceAt(t_s - h);
    const double speed_mps = 0.5 * (ahead_m + behind_m) / h;
    const double accel_mps2 = (ahead_m - behind_m) / (h * h);
    const PathPoint point = path.At(distance_m);
    const double b = response.half_wheelbase_m;
    const double w = response.half_track_m;
    const auto at = [&](double forward_m, double left_m) {
      return height(point.position_m + forward_m * point.Forward() + left_m * point.Left(),
                    distance_m + forward_m);
    };
    BodyKnot knot;
    knot.position_m << point.position_m, at(0.0, 0.0);
    knot.yaw_rad = point.heading_rad;
    if (b > 0.0) {
      const double front = 0.5 * (at(b, w) + at(b, -w));
      const double rear = 0.5 * (at(-b, w) + at(-b, -w));
      const double left = 0.5 * (at(b, w) + at(-b, w));
      const double right = 0.5 * (at(b, -w) + at(-b, -w));
      knot.position_m.z() = 0.5 * (front + rear);
      knot.pitch_rad = -std::atan2(front - rear, 2.0 * b);
      knot.roll_rad = std::atan2(left - right, 2.0 * w);
    }
    knot.pitch_rad -= response.dive_rad_per_mps2 * accel_mps2;
    knot.roll_rad += response.lean_rad_per_mps2 * speed_mps * speed_mps * point.curvature_per_m;
    knot.liveliness = std::clamp(speed_mps / response.lively_speed_mps, 0.0, 1.0);
    knots.push_back(knot);
  }
  return knots;
}

std::vector<Oscillation> CarOscillations(std::uint64_t seed) {
  Random random(seed, Purpose::kMotion, 1);
  std::vector<Oscillation> waves;
  const auto add = [&](BodyAxis axis, double amplitude, double low_hz, double high_hz) {
    waves.push_back({axis, amplitude * random.Uniform(0.7, 1.3), random.Uniform(low_hz, high_hz),
                     random.Uniform(0.0, 2.0 * std::numbers::pi)});
  };
  add(BodyAxis::kZ, 0.012, 1.0, 1.5);
  add(BodyAxis::kZ, 0.006, 1.8, 2.6);
  add(BodyAxis::kPitch, 0.006, 1.1, 1.6);
  add(BodyAxis::kRoll, 0.007, 0.9, 1.4);
  add(BodyAxis::kRoll, 0.002, 2.0, 3.0);
  add(BodyAxis::kZ, 0.00012, 8.0, 12.0);
  add(BodyAxis::kPitch, 0.0002, 7.0, 11.0);
  return waves;
}

std::vector<Oscillation> WalkOscillations(std::uint64_t seed) {
  Random random(seed, Purpose::kMotion, 2);
  const double step_hz = random.Uniform(1.7, 1.9);
  const auto phase = [&] { return random.Uniform(0.0, 2.0 * std::numbers::pi); };
  return {{BodyAxis::kZ, 0.025, step_hz, phase()},
          {BodyAxis::kX, 0.012, 0.5 * step_hz, phase()},
          {BodyAxis::kY, 0.012, 0.5 * step_hz, phase()},
          {BodyAxis::kRoll, 0.035, 0.5 * step_hz, phase()},
          {BodyAxis::kPitch, 0.030, step_hz, phase()},
          {BodyAxis::kPitch, 0.050, 0.23, phase()},
          {BodyAxis::kYaw, 0.060, 0.5 * step_hz, phase()},
          {BodyAxis::kYaw, 0.150, 0.17, phase()},
          {BodyAxis::kZ, 0.004, 2.0 * step_hz, phase()}};
}

}  // namespace lio::sim
