// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/rig_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scenario SomeScenario() {
  Scenario scenario;
  scenario.name = "yard";
  scenario.T_imu_lidar = {ExpSo3(Vector3(0.1, -0.2, 1.5)), Vector3(0.04, -0.03, 0.3)};
  scenario.own_vehicle_box = OwnVehicleBox{{-1.5, -1.0, -2.0}, {1.25, 1.0, 0.1}};
  scenario.min_range_m = 0.7;
  return scenario;
}

RecordOptions SomeSensors() {
  RecordOptions options;
  options.lidar = LoadLidarModel("vlp16");
  options.imu.name = "some imu";
  options.imu.gyro.noise_density = 2e-4;
  options.imu.gyro.bias_walk_density = 3e-5;
  options.imu.gyro.turn_on_bias_std = 0.003;
  options.imu.accel.noise_density = 4e-3;
  options.imu.accel.bias_instability = 0.004;
  options.imu.accel.bias_instability_time_s = 50.0;
  options.imu.accel.turn_on_bias_std = 0.003;
  options.gravity_mps2 = 9.79;
  return options;
}

class RigFile : public ::testing::Test {
 protected:
  // Writes the file and reads it as lio-replay does.
  Rig RoundTrip(const Scenario& scenario, const RecordOptions& options) {
    WriteRigFile(path_, scenario, options);
    const LoadResult loaded = LoadOptions({path_}, {});
    EXPECT_THAT(loaded.faults, IsEmpty());
    return loaded.options.rig;
  }
  test::TempDir dir_;
  std::filesystem::path path_ = dir_.path() / "config.yaml";
};

TEST_F(RigFile, LoadsAsTheVehicleIs) {
  const Scenario scenario = SomeScenario();
  const Rig rig = RoundTrip(scenario, SomeSensors());
  ASSERT_TRUE(rig.T_imu_lidar);
  EXPECT_LT((rig.T_imu_lidar->translation - scenario.T_imu_lidar.translation).norm(), 1e-8);
  EXPECT_LT(rig.T_imu_lidar->rotation.angularDistance(scenario.T_imu_lidar.rotation), 1e-7);
  EXPECT_EQ(rig.lidar.model, "vlp16");
  EXPECT_EQ(rig.lidar.min_range_m, 0.7);
  EXPECT_EQ(rig.lidar.max_range_m, LoadLidarModel("vlp16").max_range_m);
  ASSERT_TRUE(rig.lidar.own_vehicle_box);
  EXPECT_EQ(rig.lidar.own_vehicle_box->min_m, Vector3(-1.5, -1.0, -2.0));
  EXPECT_EQ(rig.lidar.own_vehicle_box->max_m, Vector3(1.25, 1.0, 0.1));
  EXPECT_EQ(rig.gravity_mps2, 9.79);
  EXPECT_EQ(rig.imu.gravity, GravityInput::kAutomatic);
}

// A data file of one's own has no table in liod.
TEST_F(RigFile, ALidarThatLiodDoesNotKnowIsGeneric) {
  RecordOptions options = SomeSensors();
  options.lidar.name = "my40";
  EXPECT_EQ(RoundTrip(SomeScenario(), options).lidar.model, "generic");
}

// An instability s over a time T looks like a walk of s sqrt(2 / T): 0.004 sqrt(2 / 50) = 0.0008.
TEST_F(RigFile, NoiseIsTheSensorsOwn) {
  const Rig rig = RoundTrip(SomeScenario(), SomeSensors());
  EXPECT_DOUBLE_EQ(rig.imu.gyro_noise_density, 2e-4);
  EXPECT_DOUBLE_EQ(rig.imu.accel_noise_density, 4e-3);
  EXPECT_DOUBLE_EQ(rig.imu.gyro_bias_walk_density, 3e-5);
  EXPECT_NEAR(rig.imu.accel_bias_walk_density, 8e-4, 1e-12);
  EXPECT_DOUBLE_EQ(rig.imu.gyro_bias_std_radps, 0.003);
  EXPECT_NEAR(rig.imu.accel_bias_std_mps2, 0.005, 1e-12);  // hypot(0.003, 0.004)
}

TEST_F(RigFile, WalksOfBothKindsAddInSquares) {
  RecordOptions options = SomeSensors();
  options.imu.accel.bias_walk_density = 6e-4;
  EXPECT_NEAR(RoundTrip(SomeScenario(), options).imu.accel_bias_walk_density, 1e-3, 1e-12);
}

TEST_F(RigFile, AnIdealUnitGetsWhatAFilterCanUse) {
  RecordOptions options = SomeSensors();
  options.imu = LoadImuModel("ideal");
  const Rig rig = RoundTrip(SomeScenario(), options);
  for (const double density : {rig.imu.gyro_noise_density, rig.imu.accel_noise_density,
                               rig.imu.gyro_bias_walk_density, rig.imu.accel_bias_walk_density}) {
    EXPECT_DOUBLE_EQ(density, 1e-6);
  }
  EXPECT_DOUBLE_EQ(rig.imu.gyro_bias_std_radps, 1e-5);
}

TEST_F(RigFile, NoiseIsTheClaimedUnitsWhereThereIsOne) {
  RecordOptions options = SomeSensors();
  options.claimed_imu = options.imu;
  options.claimed_imu->gyro.noise_density = 7e-4;
  EXPECT_DOUBLE_EQ(RoundTrip(SomeScenario(), options).imu.gyro_noise_density, 7e-4);
}

TEST_F(RigFile, WithoutABoxThereIsNone) {
  Scenario scenario = SomeScenario();
  scenario.own_vehicle_box.reset();
  EXPECT_FALSE(RoundTrip(scenario, SomeSensors()).lidar.own_vehicle_box);
}

TEST_F(RigFile, AWrongExtrinsicIsWhatIsClaimed) {
  RecordOptions options = SomeSensors();
  options.faults = {ParseFault("wrong_extrinsic:yaw_deg=3,x=0.2")};
  const Scenario scenario = SomeScenario();
  const Pose claimed = RoundTrip(scenario, options).T_imu_lidar.value();
  EXPECT_NEAR(claimed.rotation.angularDistance(scenario.T_imu_lidar.rotation), 3.0 * M_PI / 180.0,
              1e-7);
  EXPECT_NEAR((claimed.translation - scenario.T_imu_lidar.translation).norm(), 0.2, 1e-7);
}

TEST_F(RigFile, ACommentSaysWhereItIsFrom) {
  RoundTrip(SomeScenario(), SomeSensors());
  EXPECT_THAT(test::ReadText(path_), HasSubstr("scenario 'yard', seed 1: vlp16, some imu.\n"));
}

TEST_F(RigFile, WhatCannotBeWrittenIsNamed) {
  try {
    WriteRigFile(dir_.path() / "no" / "config.yaml", SomeScenario(), SomeSensors());
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/config.yaml"));
  }
}

}  // namespace
}  // namespace lio::sim
