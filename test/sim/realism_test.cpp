// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Each effect of the field is measured by switching it on alone.
#include "lio/sim/realism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "lio/sim/scenario.hpp"
#include "sim/closed_room.hpp"

namespace lio::sim {
namespace {

using test::Room;

RecordOptions OptionsOf(Realism realism, const std::vector<std::string>& without = {}) {
  RecordOptions options;
  options.lidar = LoadLidarModel("hdl32e");
  options.imu = LoadImuModel("xsens_mti10");
  SetRealism(realism, {{}, without}, options);
  return options;
}

// Switches on this effect of the field alone, without the errors of the data sheet.
RecordOptions Only(const std::string& effect) {
  std::vector<std::string> without = FieldEffects();
  std::erase(without, effect);
  RecordOptions options = OptionsOf(Realism::kField, without);
  options.lidar_errors.noise_scale = 0.0;
  options.lidar_errors.dropout_ratio = 0.0;
  options.lidar_errors.has_weak_echoes = false;
  options.lidar.range_step_m = 0.0;
  options.lidar_errors.has_mixed_pixels = false;
  return options;
}

SimulatedSweep SweepIn(const World& world, const RecordOptions& options) {
  MotionPlan plan;
  plan.knots.resize(4);
  const Trajectory still(plan);
  const Scene scene(world);
  return LidarSimulator({options.lidar, Pose::Identity(), options.lidar_errors, 5, 0.0}, scene,
                        still)
      .Sweep(0);
}

// Returns the range of a point less that of the room's surface along the same beam.
double RoomError(const LidarPoint& point) {
  const Vector3 p(point.x_m, point.y_m, point.z_m);
  const double height_m = p.z() > 0.0 ? 7.0 : 2.0;
  const double of_the_way =
      std::max({std::abs(p.x()) / 20.0, std::abs(p.y()) / 15.0, std::abs(p.z()) / height_m});
  return p.norm() * (1.0 - 1.0 / of_the_way);
}

TEST(Realism, IdealSensorsHaveNoErrors) {
  const RecordOptions options = OptionsOf(Realism::kIdeal);
  for (const LidarPoint& point : SweepIn(Room(), options).points) {
    ASSERT_NEAR(RoomError(point), 0.0, 1e-4);
  }
  EXPECT_EQ(options.imu.accel.noise_density, 0.0);
  EXPECT_EQ(options.imu.gyro.turn_on_bias_std, 0.0);
  EXPECT_EQ(options.imu.rate_hz, 100.0) << "the rate is the sensor's own";
  ASSERT_TRUE(options.claimed_imu);
  EXPECT_EQ(options.claimed_imu->accel.noise_density, 7.85e-4) << "the rig says the data sheet's";
}

TEST(Realism, DatasheetHasNoneOfTheFieldsEffects) {
  const RecordOptions datasheet = OptionsOf(Realism::kDatasheet);
  const RecordOptions without_all = OptionsOf(Realism::kField, FieldEffects());
  EXPECT_FALSE(datasheet.imu_effects.vibrates);
  EXPECT_EQ(datasheet.lidar_errors.laser_bias_std_m, 0.0);
  EXPECT_EQ(SweepIn(Room(), datasheet).points.size(), SweepIn(Room(), without_all).points.size());
}

TEST(Realism, AnUnknownEffectIsAnsweredWithTheKnownOnes) {
  try {
    OptionsOf(Realism::kField, {"fog"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("no effect 'fog'"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("laser-bias"));
  }
}

// Prints all switches and sizes that effects set.
std::string Described(const RecordOptions& options) {
  const LidarErrors& lidar = options.lidar_errors;
  const ImuEffects& imu = options.imu_effects;
  const ClockErrors& clock = options.clock_errors;
  std::ostringstream text;
  text << lidar.has_footprint << ' ' << lidar.in_between.reach_m << ' ' << lidar.laser_bias_std_m
       << ' ' << lidar.grazing_bias_m << ' ' << lidar.range_walk.retro_m << ' ' << lidar.has_glass
       << ' ' << lidar.beam_table_std_rad << ' ' << lidar.rotor.speed_std_ratio << ' '
       << lidar.rotor.encoder_std_rad << ' ' << clock.imu_jitter_std_s << ' '
       << clock.drift_std_ratio << ' ' << imu.vibrates << ' ' << imu.has_engine << ' '
       << imu.rectifies << ' ' << imu.is_g_sensitive << ' ' << imu.warms_up;
  return text.str();
}

TEST(Realism, EachEffectIsSwitchedAlone) {
  const std::string all = Described(OptionsOf(Realism::kField));
  const std::string none = Described(OptionsOf(Realism::kDatasheet));
  for (const std::string& effect : FieldEffects()) {
    EXPECT_NE(Described(OptionsOf(Realism::kField, {effect})), all) << effect;
    std::vector<std::string> others = FieldEffects();
    std::erase(others, effect);
    RecordOptions with = OptionsOf(Realism::kField, FieldEffects());
    SetRealism(Realism::kDatasheet, {{effect}, {}}, with);
    EXPECT_NE(Described(with), none) << effect;
    EXPECT_EQ(Described(with), Described(OptionsOf(Realism::kField, others))) << effect;
  }
}

TEST(Realism, AnEffectIsAddedToIdealSensors) {
  RecordOptions options = OptionsOf(Realism::kDatasheet);
  SetRealism(Realism::kIdeal, {{"vibration"}, {}}, options);
  EXPECT_TRUE(options.imu_effects.vibrates);
  EXPECT_EQ(options.imu.accel.noise_density, 0.0);
  EXPECT_EQ(options.imu.accel.vibration_std_per_mps, 0.012);
}

TEST(Realism, EachLaserHasItsOwnBias) {
  std::map<std::uint16_t, std::vector<double>> errors;
  for (const LidarPoint& point : SweepIn(Room(), Only("laser-bias")).points) {
    errors[point.ring].push_back(RoomError(point));
  }
  double sum_sq = 0.0;
  for (const auto& [ring, of_ring] : errors) {
    const auto [low, high] = std::minmax_element(of_ring.begin(), of_ring.end());
    EXPECT_LT(*high - *low, 2e-4) << "ring " << ring;
    sum_sq += of_ring.front() * of_ring.front();
  }
  EXPECT_EQ(errors.size(), 32u);
  EXPECT_NEAR(std::sqrt(sum_sq / 32.0), 0.008, 0.004);
}

TEST(Realism, RangesGrowAtGrazingIncidence) {
  const std::vector<LidarPoint> points = SweepIn(Room(), Only("grazing-bias")).points;
  double largest = 0.0;
  for (const LidarPoint& point : points) {
    const Vector3 p(point.x_m, point.y_m, point.z_m);
    const double error = RoomError(point);
    const bool is_floor = std::abs(p.x()) < 18.0 && std::abs(p.y()) < 13.0 && p.z() < -1.9;
    if (is_floor) {
      const double cos_incidence = -p.z() / p.norm();
      EXPECT_NEAR(error, std::min(0.006 * (1.0 / cos_incidence - 1.0), 0.04), 2e-3);
    }
    largest = std::max(largest, error);
  }
  EXPECT_GT(largest, 0.03);
  EXPECT_LT(largest, 0.041);
}

TEST(Realism, TheBeamTableIsOffByItsError) {
  double sum_sq = 0.0;
  int num = 0;
  for (const LidarPoint& point : SweepIn(Room(), Only("beam-table")).points) {
    if (point.z_m > -1.0f || std::hypot(point.x_m, point.y_m) > 12.0f) continue;  // the floor
    const double range = std::hypot(point.x_m, point.y_m, point.z_m);
    // A turned beam meets the floor elsewhere, and is drawn where the table says.
    const double sine = -point.z_m / range;
    const double off_rad = (sine * range - 2.0) / (range * std::sqrt(1.0 - sine * sine));
    sum_sq += off_rad * off_rad;
    ++num;
  }
  ASSERT_GT(num, 1000);
  EXPECT_NEAR(std::sqrt(sum_sq / num), 3.5e-4, 2e-4);
}

TEST(Realism, OneToThreePerCentOfAStreetsReturnsAreMixedPixels) {
  const Scenario street = MakeScenario("street", {1, 10.0, true});
  const RecordOptions options = OptionsOf(Realism::kField);
  const Scene scene(street.world);
  const LidarSimulator lidar(
      {options.lidar, street.T_imu_lidar, options.lidar_errors, 1, street.begin_s}, scene,
      *street.trajectory);
  std::int64_t num = 0;
  std::size_t of = 0;
  for (std::int64_t index = 0; index < 90; index += 30) {
    const SimulatedSweep sweep = lidar.Sweep(index);
    num += std::count(sweep.kinds.begin(), sweep.kinds.end(), EchoKind::kInBetween);
    of += sweep.points.size();
  }
  const double share = static_cast<double>(num) / static_cast<double>(of);
  EXPECT_GT(share, 0.008);
  EXPECT_LT(share, 0.03);
}

TEST(Realism, AStreetIsSeenInItsWindowsAndThroughThem) {
  const Scenario street = MakeScenario("street", {1, 10.0, true});
  const RecordOptions options = OptionsOf(Realism::kField);
  const Scene scene(street.world);
  const LidarSimulator lidar(
      {options.lidar, street.T_imu_lidar, options.lidar_errors, 1, street.begin_s}, scene,
      *street.trajectory);
  const SimulatedSweep sweep = lidar.Sweep(40);
  const auto share = [&](EchoKind kind) {
    return static_cast<double>(std::count(sweep.kinds.begin(), sweep.kinds.end(), kind)) /
           static_cast<double>(sweep.kinds.size());
  };
  EXPECT_GT(share(EchoKind::kMirrored), 1e-3);
  EXPECT_LT(share(EchoKind::kMirrored), 0.05);
  EXPECT_GT(share(EchoKind::kThroughGlass), 1e-3);
  EXPECT_LT(share(EchoKind::kThroughGlass), 0.05);
}

}  // namespace
}  // namespace lio::sim
