// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/beam_table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(BeamTable, OfEveryModelIsComplete) {
  const std::pair<const char*, int> models[] = {
      {"hdl32e", 32}, {"vlp16", 16}, {"hdl64e", 64}, {"os1_64", 64}};
  for (const auto& [model, num_beams] : models) {
    const BeamTable table = LoadBeamTable(model);
    EXPECT_EQ(table.model, model);
    EXPECT_EQ(table.num_beams(), num_beams);
    EXPECT_TRUE(table.clockwise);
    EXPECT_GT(table.rotation_hz, 5.0);
  }
}

TEST(BeamTable, OfTheHdl32eSpansItsManualsAngles) {
  const BeamTable table = LoadBeamTable("hdl32e");
  EXPECT_NEAR(table.elevation_rad.front(), -30.667 * kDegree, 1e-4);
  EXPECT_NEAR(table.elevation_rad.back(), 10.667 * kDegree, 1e-4);
}

TEST(BeamTable, FindsTheNearestBeam) {
  BeamTable table;
  table.elevation_rad = {-0.2, 0.0, 0.1};
  EXPECT_EQ(table.NearestBeam(-1.0), 0);
  EXPECT_EQ(table.NearestBeam(-0.11), 0);
  EXPECT_EQ(table.NearestBeam(-0.09), 1);
  EXPECT_EQ(table.NearestBeam(0.06), 2);
  EXPECT_EQ(table.NearestBeam(1.0), 2);
}

TEST(BeamTable, OfAnUnknownModelNamesTheKnownOnes) {
  for (const char* model : {"hdl33", "", "../lidars/hdl32e"}) {
    try {
      (void)LoadBeamTable(model);
      FAIL() << model;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("vlp16"), std::string::npos);
    }
  }
}

TEST(BeamTable, WithFaultsIsRefusedByName) {
  const test::TempDir dir;
  setenv("LIO_CONFIG_DIR", dir.path().c_str(), 1);
  dir.Write("lidars/a.yaml",
            "rotation_hz: 10\nbeams: {elevation_deg: [3, 1], azimuth_offset_deg: [0, 0]}\n");
  dir.Write("lidars/b.yaml",
            "rotation_hz: 10\nbeams: {elevation_deg: [1, 3], azimuth_offset_deg: [0]}\n");
  dir.Write("lidars/c.yaml", "rotation_hz: fast\n");
  dir.Write("lidars/d.yaml", "][");
  for (const char* model : {"a", "b", "c", "d"}) {
    EXPECT_THROW((void)LoadBeamTable(model), InputError) << model;
  }
  unsetenv("LIO_CONFIG_DIR");
}

}  // namespace
}  // namespace lio
