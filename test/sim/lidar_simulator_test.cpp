// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/lidar_simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "lio/convert/kitti_files.hpp"
#include "lio/convert/kitti_raw.hpp"
#include "lio/sim/random.hpp"
#include "sim/closed_room.hpp"
#include "sim/spread.hpp"

namespace lio::sim {
namespace {

using test::Room;
using test::Spread;
using test::Still;

// The scene is a room of 40 x 30 x 9 m around the origin: every return lies on one of six known
// planes.
struct Plane {
  Vector3 normal;
  double distance_m;
};
const std::vector<Plane>& RoomPlanes() {
  static const std::vector<Plane> planes = {{{1, 0, 0}, 20},  {{-1, 0, 0}, 20}, {{0, 1, 0}, 15},
                                            {{0, -1, 0}, 15}, {{0, 0, 1}, 7},   {{0, 0, -1}, 2}};
  return planes;
}

// The sensor is swung about and carried through the room.
Trajectory Swinging() {
  MotionPlan plan;
  plan.knot_interval_s = 0.1;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    BodyKnot knot;
    knot.position_m = {3.0 * std::sin(0.9 * t), 2.0 * std::cos(1.3 * t), 0.5 * std::sin(2.0 * t)};
    knot.yaw_rad = 3.0 * t;
    knot.pitch_rad = 0.4 * std::sin(2.5 * t);
    knot.roll_rad = 0.3 * std::cos(2.1 * t);
    plan.knots.push_back(knot);
  }
  plan.T_body_imu = {ExpSo3({0.1, 0.2, -0.4}), {0.1, 0.0, 0.2}};
  return Trajectory(plan);
}

LidarSetup SetupOf(const std::string& model) {
  LidarSetup setup;
  setup.model = LoadLidarModel(model);
  setup.T_imu_lidar = {ExpSo3({0.05, -0.1, 1.2}), {0.05, -0.02, 0.3}};
  setup.seed = 4;
  return setup;
}

// Returns the distance of a return from the surface along its ray, assuming the sensor's pose
// T_world_lidar; the surface is the plane that the ray meets first.
double RangeError(const Pose& T_world_lidar, const LidarPoint& point) {
  const Vector3 p(point.x_m, point.y_m, point.z_m);
  const Vector3 direction = T_world_lidar.rotation * p.normalized();
  double range_m = 1e9;
  for (const Plane& plane : RoomPlanes()) {
    const double rate = plane.normal.dot(direction);
    if (rate <= 0.0) continue;
    range_m =
        std::min(range_m, (plane.distance_m - plane.normal.dot(T_world_lidar.translation)) / rate);
  }
  return p.norm() - range_m;
}

// Returns the spread over all returns of ten sweeps, posed at their own instants or at their
// sweep's begin.
Spread SpreadOfWalls(const LidarSetup& setup, bool own_instants) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Swinging();
  const LidarSimulator lidar(setup, scene, trajectory);
  double sum = 0.0;
  double sum_sq = 0.0;
  std::int64_t num = 0;
  for (std::int64_t index = 5; index < 15; ++index) {
    const SimulatedSweep sweep = lidar.Sweep(index);
    for (std::size_t i = 0; i < sweep.points.size(); i += 7) {
      const LidarPoint& point = sweep.points[i];
      const std::int64_t t_ns = sweep.begin_ns + (own_instants ? point.t_offset_ns : 0);
      const Pose pose =
          trajectory.At(1e-9 * static_cast<double>(t_ns)).T_world_imu * setup.T_imu_lidar;
      const double error = RangeError(pose, point);
      if (own_instants && std::abs(error) > 0.3)
        continue;  // rays at grazing incidence near the room's edges
      sum += error;
      sum_sq += error * error;
      ++num;
    }
  }
  EXPECT_GT(num, 10000);
  const double mean = sum / static_cast<double>(num);
  return {mean, std::sqrt(sum_sq / static_cast<double>(num) - mean * mean)};
}

TEST(LidarSimulator, PointsPosedAtTheirOwnInstantsLeaveWallsFlatToTheRangeNoise) {
  for (const char* model : {"hdl32e", "vlp16", "os1_64"}) {
    const LidarSetup setup = SetupOf(model);
    const Spread own = SpreadOfWalls(setup, true);
    EXPECT_NEAR(own.mean, 0.0, 1e-3) << model;
    // The noise is 2 cm at normal incidence and slightly more at an angle.
    EXPECT_GT(own.std, 0.95 * setup.model.range_std_m) << model;
    EXPECT_LT(own.std, 1.25 * setup.model.range_std_m) << model;
    // The test can detect wrong instants: with one pose per sweep the error is metres.
    EXPECT_GT(SpreadOfWalls(setup, false).std, 0.5) << model;
  }
}

TEST(LidarSimulator, WithoutErrorsPointsLieOnTheWallsToTheResolution) {
  LidarSetup setup = SetupOf("hdl32e");
  setup.errors.noise_scale = 0.0;
  setup.errors.has_mixed_pixels = false;
  const Spread own = SpreadOfWalls(setup, true);
  EXPECT_NEAR(own.mean, 0.0, 2e-4);
  EXPECT_LT(own.std, 1.2 * setup.model.range_step_m / std::sqrt(12.0));
}

TEST(LidarSimulator, EveryRayOfAClosedRoomReturnsWithoutDropouts) {
  LidarSetup setup = SetupOf("hdl32e");
  setup.errors.dropout_ratio = 0.0;
  setup.errors.has_weak_echoes = false;
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Still();
  const SimulatedSweep sweep = LidarSimulator(setup, scene, trajectory).Sweep(0);
  EXPECT_EQ(sweep.num_rays, 2171 * 32);
  EXPECT_EQ(static_cast<std::int64_t>(sweep.points.size()), sweep.num_rays);
}

TEST(LidarSimulator, SweepsFollowEachOtherAndPointsComeInOrderOfFiring) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Swinging();
  const LidarSetup setup = SetupOf("vlp16");
  const LidarSimulator lidar(setup, scene, trajectory);
  std::int64_t last_ns = -1;
  for (std::int64_t index = 0; index < 4; ++index) {
    const SimulatedSweep sweep = lidar.Sweep(index);
    for (const LidarPoint& point : sweep.points) {
      ASSERT_GT(sweep.begin_ns + point.t_offset_ns, last_ns);
      last_ns = sweep.begin_ns + point.t_offset_ns;
      ASSERT_LT(point.ring, 16);
    }
    EXPECT_NEAR(1e-9 * static_cast<double>(sweep.begin_ns), 0.1 * static_cast<double>(index), 6e-5);
    EXPECT_NEAR(lidar.SweepEnd_s(index), 1e-9 * static_cast<double>(last_ns), 6e-5);
  }
}

TEST(LidarSimulator, RingsAreElevationsLowestFirst) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Swinging();
  const LidarSetup setup = SetupOf("hdl32e");
  for (const LidarPoint& p : LidarSimulator(setup, scene, trajectory).Sweep(2).points) {
    const double elevation = std::atan2(p.z_m, std::hypot(p.x_m, p.y_m));
    ASSERT_NEAR(elevation, setup.model.beams[p.ring].elevation_rad, 1e-5);
  }
}

// These conditions are what lio-convert kitti-raw assumes: points are stored ring by ring, the
// highest first, each from azimuth 0 upward and around; the stamp is the instant of facing forward,
// and time runs against azimuth.
TEST(LidarSimulator, Hdl64SweepsInKittiOrderHaveTheConvertersRingsAndTimes) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Swinging();
  LidarSetup setup = SetupOf("hdl64e");
  setup.model.rotation_hz = 1.0 / 0.1033;
  const Duration turn = Duration::FromSeconds(0.1033);
  const SimulatedSweep sweep = LidarSimulator(setup, scene, trajectory).Sweep(3);
  std::vector<LidarPoint> points = sweep.points;
  const auto around = [](const LidarPoint& p) {
    const double azimuth = std::atan2(double{p.y_m}, double{p.x_m});
    return azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth;
  };
  std::stable_sort(points.begin(), points.end(), [&](const LidarPoint& a, const LidarPoint& b) {
    return a.ring != b.ring ? a.ring > b.ring : around(a) < around(b);
  });
  std::vector<LidarPoint> read = points;
  for (LidarPoint& point : read) point.ring = 0;
  AssignKittiRings(read);
  const Timestamp middle = Timestamp{sweep.begin_ns} + Duration{turn.ns / 2};
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(read[i].ring, points[i].ring) << "point " << i;
    // A beam's own azimuth offset is a time that the formula cannot know: 9.8 deg are 2.8 ms.
    const double offset_rad = setup.model.beams[points[i].ring].azimuth_offset_rad;
    const double from_azimuth_s =
        1e-9 * static_cast<double>(KittiPointInstant(points[i], middle, turn) - sweep.begin_ns);
    double late_s = 1e-9 * points[i].t_offset_ns - from_azimuth_s -
                    offset_rad / (2.0 * std::numbers::pi) * turn.Seconds();
    late_s =
        std::remainder(late_s, turn.Seconds());  // the offset may cross the cut behind the sensor
    ASSERT_NEAR(late_s, 0.0, 6e-5) << "point " << i;
  }
}

TEST(LidarSimulator, SameSeedSameSweepAnotherSeedOtherNoise) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Swinging();
  LidarSetup setup = SetupOf("vlp16");
  const auto ranges = [&] {
    std::vector<float> x;
    for (const LidarPoint& p : LidarSimulator(setup, scene, trajectory).Sweep(1).points) {
      x.push_back(p.x_m);
    }
    return x;
  };
  const auto first = ranges();
  EXPECT_EQ(first, ranges());
  setup.seed = 5;
  EXPECT_NE(first, ranges());
}

std::map<int, double> MeanIntensityByMaterial() {
  std::map<int, double> mean;
  for (const Material material : {Material::kAsphalt, Material::kPlaster, Material::kRetro}) {
    const World world = Room(material);
    const Scene scene(world);
    const Trajectory trajectory = Still();
    double sum = 0.0;
    const SimulatedSweep sweep = LidarSimulator(SetupOf("vlp16"), scene, trajectory).Sweep(0);
    for (const LidarPoint& p : sweep.points) sum += p.intensity;
    mean[static_cast<int>(material)] = sum / static_cast<double>(sweep.points.size());
  }
  return mean;
}

TEST(LidarSimulator, IntensityTellsMaterialsApart) {
  auto mean = MeanIntensityByMaterial();
  EXPECT_LT(mean[static_cast<int>(Material::kAsphalt)], 17.0);
  EXPECT_GT(mean[static_cast<int>(Material::kPlaster)], 30.0);
  EXPECT_LT(mean[static_cast<int>(Material::kPlaster)], 60.0);
  EXPECT_GT(mean[static_cast<int>(Material::kRetro)], 150.0);
}

TEST(LidarSimulator, DarkAndSlantedSurfacesFarOffAreLost) {
  World world;  // a road 2 m below the sensor
  AddQuad(world.fixed.page(), {-200, -200, -2}, {200, -200, -2}, {200, 200, -2}, {-200, 200, -2},
          Material::kAsphalt);
  const Scene scene(world);
  const Trajectory trajectory = Still();
  LidarSetup setup = SetupOf("hdl32e");
  setup.T_imu_lidar = Pose::Identity();
  std::map<int, int> num_by_ring;
  for (const LidarPoint& p : LidarSimulator(setup, scene, trajectory).Sweep(0).points) {
    ++num_by_ring[p.ring];
  }
  EXPECT_GT(num_by_ring[0], 2150);   // at 3.9 m
  EXPECT_GT(num_by_ring[18], 1900);  // at 17 m
  EXPECT_LT(num_by_ring[22], 400);   // at 86 m
}

TEST(LidarSimulator, BeamsThatStraddleAnEdgeGiveMixedPixels) {
  World world;  // a plate 0.4 m before a wall
  AddQuad(world.fixed.page(), {10, -30, -10}, {10, 30, -10}, {10, 30, 10}, {10, -30, 10},
          Material::kPlaster);
  AddQuad(world.fixed.page(), {9.6, -2, -10}, {9.6, 2, -10}, {9.6, 2, 10}, {9.6, -2, 10},
          Material::kPlaster);
  const Scene scene(world);
  const Trajectory trajectory = Still();
  LidarSetup setup = SetupOf("hdl32e");
  setup.T_imu_lidar = Pose::Identity();
  setup.errors.noise_scale = 0.0;
  const auto count_between = [&](bool mixed) {
    setup.errors.has_mixed_pixels = mixed;
    int num = 0;
    for (const LidarPoint& p : LidarSimulator(setup, scene, trajectory).Sweep(0).points) {
      num += p.x_m > 9.65f && p.x_m < 9.95f ? 1 : 0;
    }
    return num;
  };
  EXPECT_EQ(count_between(false), 0);
  EXPECT_GT(count_between(true), 5);
  EXPECT_LT(count_between(true), 130);  // 32 rings, two edges, two columns each
}

TEST(LidarSimulator, MovingObjectsAreSeenWhereTheyAreAtTheirInstant) {
  World world;
  Mesh wall;
  AddQuad(wall, {0, -40, -10}, {0, 40, -10}, {0, 40, 10}, {0, -40, 10}, Material::kPlaster);
  world.shapes.push_back(wall);
  const auto wall_x = [](double t) { return 25.0 - 12.0 * t; };
  world.movers.push_back({0, [=](double t) { return UprightPose({wall_x(t), 0.0, 0.0}, 0.0); }});
  const Scene scene(world);
  const Trajectory trajectory = Still();
  LidarSetup setup = SetupOf("os1_64");
  setup.T_imu_lidar = Pose::Identity();
  setup.errors.noise_scale = 0.0;
  setup.errors.has_mixed_pixels = false;
  const SimulatedSweep sweep = LidarSimulator(setup, scene, trajectory).Sweep(4);
  ASSERT_GT(sweep.points.size(), 5000u);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const double t_s = 1e-9 * static_cast<double>(sweep.begin_ns + sweep.points[i].t_offset_ns);
    ASSERT_NEAR(sweep.points[i].x_m, wall_x(t_s), 0.002);
    ASSERT_EQ(sweep.objects[i], 0);
  }
}

TEST(LidarSimulator, DustGivesNearEchoesWhileItLasts) {
  const World world = Room();
  const Scene scene(world);
  const Trajectory trajectory = Still();
  LidarSetup setup = SetupOf("vlp16");
  setup.errors.dust = {{0.1005, 0.1995, 0.1}};  // sweep 1, except firings that straddle its ends
  const LidarSimulator lidar(setup, scene, trajectory);
  const auto share_near = [&](std::int64_t index) {
    const SimulatedSweep sweep = lidar.Sweep(index);
    const auto num = std::count_if(sweep.points.begin(), sweep.points.end(), [](const auto& p) {
      return Vector3f(p.x_m, p.y_m, p.z_m).norm() < 5.0f && std::abs(p.z_m) < 1.4f;
    });
    return static_cast<double>(num) / static_cast<double>(sweep.points.size());
  };
  EXPECT_EQ(share_near(0), 0.0);
  EXPECT_NEAR(share_near(1), 1.0 - std::exp(-0.41), 0.05);  // between 0.9 and 5 m
  EXPECT_EQ(share_near(2), 0.0);
}

}  // namespace
}  // namespace lio::sim
