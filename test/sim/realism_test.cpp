// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests which errors a grade has; their sizes are measured in lidar_effects_test.cpp,
// imu_effects_test.cpp, clock_errors_test.cpp and rotor_test.cpp.
#include "lio/sim/realism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sim/closed_room.hpp"
#include "sim/field_sweep.hpp"

namespace lio::sim {
namespace {

using test::OptionsOf;
using test::Room;
using test::RoomError;
using test::SweepIn;

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
       << ' ' << lidar.has_relief << ' ' << lidar.beam_table_std_rad << ' '
       << lidar.rotor.speed_std_ratio << ' ' << lidar.rotor.encoder_std_rad << ' '
       << clock.imu_jitter_std_s << ' ' << clock.drift_std_ratio << ' ' << imu.vibrates << ' '
       << imu.has_engine << ' ' << imu.rectifies << ' ' << imu.is_g_sensitive << ' '
       << imu.warms_up;
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

}  // namespace
}  // namespace lio::sim
