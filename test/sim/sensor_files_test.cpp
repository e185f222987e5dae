// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <stdexcept>

#include "lio/sim/imu_model.hpp"
#include "lio/sim/lidar_model.hpp"
#include "support/temp_dir.hpp"

namespace lio::sim {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Expected {
  const char* name;
  std::size_t num_beams;
  double lowest_deg;
  double highest_deg;
  int rays_per_turn;  // whole columns
};

class LidarModels : public ::testing::TestWithParam<Expected> {};

TEST_P(LidarModels, AreAsTheirMakersSay) {
  const Expected expected = GetParam();
  const LidarModel model = LoadLidarModel(expected.name);
  EXPECT_EQ(model.name, expected.name);
  ASSERT_EQ(model.beams.size(), expected.num_beams);
  EXPECT_NEAR(kDegrees * model.beams.front().elevation_rad, expected.lowest_deg, 0.01);
  EXPECT_NEAR(kDegrees * model.beams.back().elevation_rad, expected.highest_deg, 0.01);
  const double columns = 1.0 / (model.rotation_hz * model.column_period_s);
  EXPECT_EQ(static_cast<int>(columns + 1e-6) * static_cast<int>(expected.num_beams),
            expected.rays_per_turn);
  for (const Beam& beam : model.beams) EXPECT_LT(beam.fire_time_s, model.column_period_s);
}

INSTANTIATE_TEST_SUITE_P(All, LidarModels,
                         ::testing::Values(Expected{"hdl32e", 32, -30.667, 10.667, 2170 * 32},
                                           Expected{"vlp16", 16, -15.0, 15.0, 1808 * 16},
                                           Expected{"hdl64e", 64, -24.33, 2.0, 2084 * 64},
                                           Expected{"os1_64", 64, -16.611, 16.611, 1024 * 64}),
                         [](const auto& test) { return test.param.name; });

TEST(LidarModel, VelodynesFireOneBeamAfterTheOther) {
  for (const char* name : {"hdl32e", "vlp16"}) {
    const LidarModel model = LoadLidarModel(name);
    std::set<double> times;
    for (const Beam& beam : model.beams) times.insert(beam.fire_time_s);
    EXPECT_EQ(times.size(), model.beams.size()) << name;
  }
}

TEST(LidarModel, UnknownNameListsTheKnownOnes) {
  try {
    (void)LoadLidarModel("hdl33");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("hdl32e"), std::string::npos) << error.what();
  }
}

TEST(LidarModel, FaultyFilesNameFileAndKey) {
  const test::TempDir dir;
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"model: x\n", "rotation_hz"},
           {"model: [\n", "own.yaml"},
           {"model: x\nrotation_hz: fast\n", "rotation_hz"}}) {
    const auto file = dir.Write("own.yaml", text);
    try {
      (void)LoadLidarModel(file.string());
      FAIL() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST(ImuModel, PresetsRankAsTheirClasses) {
  const ImuModel xsens = LoadImuModel("xsens_mti10");
  const ImuModel consumer = LoadImuModel("consumer_mems");
  const ImuModel ideal = LoadImuModel("ideal");
  EXPECT_GT(consumer.gyro.turn_on_bias_std, xsens.gyro.turn_on_bias_std);
  EXPECT_GT(consumer.accel.noise_density, xsens.accel.noise_density);
  EXPECT_EQ(ideal.gyro.noise_density, 0.0);
  EXPECT_EQ(ideal.accel.step, 0.0);
  EXPECT_EQ(xsens.rate_hz, 100.0);
}

}  // namespace
}  // namespace lio::sim
