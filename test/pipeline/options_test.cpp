// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Options Usable() {
  Options options;
  options.rig.T_imu_lidar = Pose::Identity();
  return options;
}

auto FaultOf(const std::string& key) {
  return Field(&OptionFault::key, key);
}

TEST(Options, DefaultsWithAnExtrinsicAreUsable) {
  EXPECT_THAT(Validate(Usable()), IsEmpty());
}

TEST(Options, ImuNeedsAnExtrinsic) {
  Options options;
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.T_imu_lidar")));
  options.pipeline.use_imu = false;
  EXPECT_THAT(Validate(options), IsEmpty());
}

TEST(Options, AllFaultsAreReportedAtOnce) {
  Options options = Usable();
  options.ndt.voxel_m = -1;
  options.filter.history_s = std::nan("");
  options.rig.imu.gyro_noise_density = 0;
  options.reduce.target_points = 0;
  options.rig.lidar.model = "HDL 32";
  EXPECT_THAT(Validate(options),
              UnorderedElementsAre(FaultOf("ndt.voxel_m"), FaultOf("filter.history_s"),
                                   FaultOf("rig.imu.gyro_noise_density"),
                                   FaultOf("reduce.target_points"), FaultOf("rig.lidar.model")));
}

TEST(Options, FaultNamesValueAndRange) {
  Options options = Usable();
  options.start.rest_s = 2.0;
  const auto faults = Validate(options);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].message, "is 2, must be within 0.1 .. 1.5");
}

TEST(Options, RotationOffUnitNormIsRefused) {
  Options options = Usable();
  options.rig.T_imu_lidar->rotation = Quaternion(1.002, 0, 0, 0);
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.T_imu_lidar.rotation_wxyz")));
  options.rig.T_imu_lidar->rotation = Quaternion(std::nan(""), 0, 0, 0);
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.T_imu_lidar.rotation_wxyz")));
}

TEST(Options, NonFiniteTranslationIsRefused) {
  Options options = Usable();
  options.rig.T_imu_lidar->translation.y() = INFINITY;
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.T_imu_lidar.translation_m")));
}

TEST(Options, FeaturesCannotBePublishedByAMethodThatHasNone) {
  Options options = Usable();
  options.pipeline.publish_features = true;
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("pipeline.publish_features")));
  options.pipeline.method = MatchMethod::kLoam;
  EXPECT_THAT(Validate(options), IsEmpty());
}

TEST(Options, ContradictionsBetweenFieldsAreFound) {
  Options options = Usable();
  options.rig.lidar.min_range_m = options.rig.lidar.max_range_m = 50;
  options.reduce.min_voxel_m = 1;
  options.ndt.max_cell_points = options.ndt.min_cell_points;
  options.rig.lidar.own_vehicle_box = OwnVehicleBox{{-1, -1, 1}, {1, 1, 1}};
  EXPECT_THAT(
      Validate(options),
      UnorderedElementsAre(FaultOf("rig.lidar.min_range_m"), FaultOf("reduce.min_voxel_m"),
                           FaultOf("ndt.min_cell_points"), FaultOf("rig.lidar.own_vehicle_box")));
}

TEST(Options, ListsOfBeamsAreAsLongAsThereAreRings) {
  Options options = Usable();
  options.rig.lidar.beams.emplace();
  EXPECT_THAT(Validate(options), testing::Contains(FaultOf("rig.lidar.beams.range_m")));
  const std::vector<double> zeros(129, 0.0);
  const std::vector<double> ones(129, 1.0);
  options.rig.lidar.beams = LidarBeams{zeros, ones, zeros, ones, zeros, ones, {0, 0}, {1, 1}};
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.lidar.beams.range_m")));
  options.rig.lidar.beams = LidarBeams{{0, 0}, {1}, {0, 0}, {1, 1}, {0}, {1, 1}, {0}, {1, 1}};
  EXPECT_THAT(Validate(options), UnorderedElementsAre(FaultOf("rig.lidar.beams.range_std_m"),
                                                      FaultOf("rig.lidar.beams.azimuth_rad"),
                                                      FaultOf("rig.lidar.beams.encoder_rad")));
}

}  // namespace
}  // namespace lio
