// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lidar_check.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "lio/io/beam_table.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kFarEnough_m = 100.0;
constexpr int kNumSweeps = 200;

// A VLP-16 on its way sees walls that pass by, and where it is told to a bonnet ahead of it or a
// floor all around, both always at the same place.
struct Scene {
  bool has_bonnet = false;
  bool has_floor = false;
  double sweep_s = 0.1;  // span of the points' times; sweeps are 0.1 s apart
};

LidarPoint PointAt(double azimuth_deg, double elevation_rad, double range_m, int ring) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
  LidarPoint point;
  point.x_m = static_cast<float>(range_m * std::cos(elevation_rad) * std::cos(azimuth));
  point.y_m = static_cast<float>(range_m * std::cos(elevation_rad) * std::sin(azimuth));
  point.z_m = static_cast<float>(range_m * std::sin(elevation_rad));
  point.ring = static_cast<std::uint16_t>(ring);
  return point;
}

ScanChunk Sweep(const Scene& scene, int number) {
  static const std::vector<double> beams = LoadBeamTable("vlp16").elevation_rad;
  ScanChunk chunk;
  chunk.stamp = Timestamp{number * 100'000'000LL};
  chunk.scan_seq = number;
  for (int step = 0; step < 180; ++step) {
    for (int ring = 0; ring < 16; ++ring) {
      const bool is_bonnet = scene.has_bonnet && ring < 4 && step < 10;
      const bool is_floor = scene.has_floor && ring == 0;
      const double wall_m = 2.0 + 0.05 * ((number * 7 + step) % 40);
      const double range_m = is_bonnet ? 1.8 : is_floor ? 1.6 : wall_m;
      chunk.points.push_back(
          PointAt(2.0 * step + 1.0, beams[static_cast<std::size_t>(ring)], range_m, ring));
      chunk.points.back().t_offset_ns =
          static_cast<std::uint32_t>(1e9 * scene.sweep_s * step / 180);
    }
  }
  return chunk;
}

std::vector<Cause> Check(const Scene& scene, const LidarRig& lidar, double path_m = kFarEnough_m) {
  Options options;
  options.rig.lidar = lidar;
  LidarCheck check(options);
  for (int k = 0; k < kNumSweeps; ++k) check.Add(Sweep(scene, k));
  return check.Find(path_m);
}

LidarRig Vlp16() {
  LidarRig lidar;
  lidar.model = "vlp16";
  return lidar;
}

TEST(LidarCheck, NothingIsSaidOfARightRig) {
  EXPECT_THAT(Check({}, Vlp16()), IsEmpty());
  EXPECT_THAT(Check({}, LidarRig{}), IsEmpty()) << "generic says nothing of the beams";
}

TEST(LidarCheck, ALidarOfAnotherModelIsNamed) {
  LidarRig lidar = Vlp16();
  lidar.model = "hdl32e";
  const auto causes = Check({}, lidar);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].kind, CauseKind::kLidarModel);
  EXPECT_EQ(causes[0].leaves, Trust::kYes);
  EXPECT_THAT(causes[0].evidence, HasSubstr("the sweeps have 16 rings"));
  EXPECT_EQ(causes[0].fix, "rig:\n  lidar:\n    model: vlp16\n");
}

TEST(LidarCheck, TheVehicleIsToldFromWhatPassesByAndItsBoxMendsIt) {
  const Scene scene{.has_bonnet = true};
  const auto causes = Check(scene, Vlp16());
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].kind, CauseKind::kOwnVehicle);
  EXPECT_THAT(causes[0].fix, HasSubstr("own_vehicle_box"));
  LidarRig boxed = Vlp16();
  boxed.own_vehicle_box = {Vector3(1.4, -0.1, -0.6), Vector3(1.9, 0.7, -0.2)};
  EXPECT_THAT(Check(scene, boxed), IsEmpty());
  EXPECT_THAT(Check(scene, Vlp16(), 5.0), IsEmpty()) << "on a short way all may stand still";
}

TEST(LidarCheck, AFloorAllAroundIsNoVehicle) {
  EXPECT_THAT(Check({.has_floor = true}, Vlp16()), IsEmpty());
}

TEST(LidarCheck, PointsOfOneTimeAreToldWhereAnImuCouldTakeOutTheMotion) {
  const auto causes = Check({.sweep_s = 1e-4}, Vlp16());
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].kind, CauseKind::kPointTime);
  EXPECT_EQ(causes[0].leaves, Trust::kDoubtful);
  Options options;
  options.rig.lidar = Vlp16();
  options.pipeline.use_imu = false;
  LidarCheck check(options);
  for (int k = 0; k < kNumSweeps; ++k) check.Add(Sweep({.sweep_s = 0.0}, k));
  EXPECT_THAT(check.Find(kFarEnough_m), IsEmpty()) << "scans may be compensated already";
}

}  // namespace
}  // namespace lio
