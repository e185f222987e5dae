// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/own_vehicle_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr int kNumSweeps = 25;

// A lidar of 16 beams in a lane along x; a wall on either side, at a distance and in a direction
// that vary as the body sways and turns, and where it is told to a bonnet ahead. Ranges have a
// noise of 2 cm.
struct Lane {
  double half_width_m = 50.0;
  double sway_m = 0.01;
  double turn_deg = 0.0;
  bool has_bonnet = false;
};

class Recorder {
 public:
  explicit Recorder(const Lane& lane) : lane_(lane) {}

  void AddSweep(OwnVehicleFinder& finder) {
    finder.BeginSweep();
    sway_m_ = lane_.sway_m * normal_(random_);
    turn_rad_ = lane_.turn_deg / kDegPerRad * normal_(random_);
    for (int step = 0; step < 360; ++step) {
      for (int ring = 0; ring < 16; ++ring) Cast(step, 2.0 * ring - 15.0, finder);
    }
  }

 private:
  void Cast(double azimuth_deg, double elevation_deg, OwnVehicleFinder& finder) {
    const double azimuth = azimuth_deg / kDegPerRad;
    const double elevation = elevation_deg / kDegPerRad;
    const Vector3 direction(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const double across = std::cos(elevation) * std::sin(azimuth + turn_rad_);
    const double side_m = lane_.half_width_m + (across > 0.0 ? sway_m_ : -sway_m_);
    double range_m = side_m / std::max(1e-3, std::abs(across));
    const bool is_ahead = azimuth_deg < 15.0 || azimuth_deg > 345.0;
    if (lane_.has_bonnet && is_ahead && elevation_deg < -8.0) range_m = std::min(range_m, 1.1);
    range_m += 0.02 * normal_(random_);
    const Vector3 p = range_m * direction;
    LidarPoint point;
    point.x_m = static_cast<float>(p.x());
    point.y_m = static_cast<float>(p.y());
    point.z_m = static_cast<float>(p.z());
    finder.Add(point);
  }

  Lane lane_;
  double sway_m_ = 0.0, turn_rad_ = 0.0;  // in the present sweep
  std::mt19937_64 random_{3};
  std::normal_distribution<double> normal_;
};

std::optional<OwnVehicleFinder::Found> FindIn(const Lane& lane, const LidarRig& rig = {},
                                              int num_sweeps = kNumSweeps) {
  OwnVehicleFinder finder(rig);
  Recorder recorder(lane);
  for (int i = 0; i < num_sweeps; ++i) recorder.AddSweep(finder);
  return finder.Find();
}

LidarRig Near() {
  LidarRig rig;
  rig.min_range_m = 0.3;
  return rig;
}

TEST(OwnVehicleFinder, FindsABonnetAndItsBox) {
  const auto found = FindIn({.has_bonnet = true}, Near());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->num_directions, 60, 8);
  EXPECT_NEAR(found->box.max_m.x(), 1.1, 0.1);
  EXPECT_NEAR(found->box.min_m.z(), -0.3, 0.1);
  EXPECT_LT(found->box.max_m.z(), -0.05);
}

TEST(OwnVehicleFinder, WallsAlongsideALaneAreNoVehicle) {
  EXPECT_FALSE(FindIn({}, Near()));
  for (const double half_width_m : {0.8, 1.2, 1.8, 2.3}) {
    for (const double sway_m : {0.003, 0.01, 0.03}) {
      for (const double turn_deg : {0.0, 1.0, 3.0}) {
        const Lane lane = {.half_width_m = half_width_m, .sway_m = sway_m, .turn_deg = turn_deg};
        EXPECT_FALSE(FindIn(lane, Near())) << half_width_m << " " << sway_m << " " << turn_deg;
      }
    }
  }
}

TEST(OwnVehicleFinder, ABonnetIsFoundBetweenWallsToo) {
  const auto alone = FindIn({.has_bonnet = true}, Near());
  const auto between = FindIn({.half_width_m = 1.6, .turn_deg = 2.0, .has_bonnet = true}, Near());
  ASSERT_TRUE(alone && between);
  EXPECT_NEAR(between->num_directions, alone->num_directions, 4);
  EXPECT_LT((between->box.max_m - alone->box.max_m).norm(), 0.1);
}

TEST(OwnVehicleFinder, SaysNothingOfAFewSweepsNorOfWhatTheRigKnows) {
  EXPECT_FALSE(FindIn({.has_bonnet = true}, Near(), 15));
  LidarRig boxed = Near();
  boxed.own_vehicle_box = {Vector3(0.8, -0.4, -0.5), Vector3(1.3, 0.4, 0.0)};
  EXPECT_FALSE(FindIn({.has_bonnet = true}, boxed));
}

}  // namespace
}  // namespace lio
