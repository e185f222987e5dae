// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the text of PrintOptions; options_yaml_test.cpp tests that it loads as the same values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lio/io/options_yaml.hpp"
#include "support/beams.hpp"

namespace lio {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Returns the text after `key: ` up to the comment.
std::string ValueOf(const std::string& text, const std::string& key) {
  for (const std::string& line : Lines(text)) {
    const std::size_t at = line.find(key + ": ");
    if (at == std::string::npos || line.find_first_not_of(' ') != at) continue;
    const std::size_t begin = at + key.size() + 2;
    const std::string value = line.substr(begin, line.find(" #") - begin);
    return value.substr(0, value.find_last_not_of(' ') + 1);
  }
  return "no such key";
}

TEST(OptionsPrint, LinesCarryMeaningUnitAndRange) {
  EXPECT_THAT(PrintOptions(Options{}),
              HasSubstr("  history_s: 3.0                       # how late a measurement may come "
                        "[s]; 0.1 .. 60\n"));
}

TEST(OptionsPrint, OfAResultIsTheSameForAnyCountOfThreads) {
  Options one;
  Options three;
  three.pipeline.num_threads = 3;
  EXPECT_EQ(PrintResultOptions(one), PrintResultOptions(three));
  EXPECT_EQ(Lines(PrintResultOptions(one)).size() + 1, Lines(PrintOptions(one)).size());
}

TEST(OptionsPrint, NamesSayWhichThereAre) {
  Options options;
  options.rig.imu.gravity = GravityInput::kRemoved;
  const std::string text = PrintOptions(options);
  EXPECT_EQ(ValueOf(text, "gravity"), "removed");
  EXPECT_THAT(text, HasSubstr("; one of auto, present, removed\n"));
}

// The number is the shortest text that reads back as the same bits, and has a point for YAML 1.1.
TEST(OptionsPrint, NumbersAreShortAndExact) {
  Options options;
  const std::vector<std::pair<double, std::string>> cases = {
      {2.0, "2.0"},
      {0.1, "0.1"},
      {0.1 + 0.2, "0.30000000000000004"},
      {-1e-7, "-1.0e-07"},
      {123456789.0, "123456789.0"},
      {1e-300, "1.0e-300"},
  };
  for (const auto& [value, text] : cases) {
    options.ndt.voxel_m = value;
    const std::string printed = PrintOptions(options);
    EXPECT_THAT(printed, HasSubstr("  voxel_m: " + text + " "));
    EXPECT_EQ(std::stod(text), value);
  }
  options.ndt.max_cells = 7;
  EXPECT_EQ(ValueOf(PrintOptions(options), "max_cells"), "7");
  options.pipeline.use_imu = false;
  EXPECT_EQ(ValueOf(PrintOptions(options), "use_imu"), "false");
}

TEST(OptionsPrint, AnAbsentGroupIsShownInComments) {
  const std::string text = PrintOptions(Options{});
  EXPECT_THAT(text, ContainsRegex("\n    # own_vehicle_box: +# "));
  EXPECT_THAT(text, HasSubstr("\n    #   min_m: [0.0, 0.0, 0.0] "));
  EXPECT_EQ(ValueOf(text, "min_m"), "no such key");
}

TEST(OptionsPrint, AGivenGroupIsShownWithItsValues) {
  Options options;
  options.rig.lidar.own_vehicle_box = OwnVehicleBox{{-1, -2, -3}, {1, 2, 0.5}};
  options.rig.T_imu_lidar = Pose{Quaternion(0.5, 0.5, -0.5, 0.5), {1, 2, 3.25}};
  const std::string text = PrintOptions(options);
  EXPECT_EQ(ValueOf(text, "min_m"), "[-1.0, -2.0, -3.0]");
  EXPECT_EQ(ValueOf(text, "max_m"), "[1.0, 2.0, 0.5]");
  EXPECT_EQ(ValueOf(text, "translation_m"), "[1.0, 2.0, 3.25]");
  EXPECT_EQ(ValueOf(text, "rotation_wxyz"), "[0.5, 0.5, -0.5, 0.5]");  // w first
  EXPECT_THAT(text, Not(HasSubstr("# own_vehicle_box")));
}

TEST(OptionsPrint, EveryLineIsExplained) {
  const std::string text = PrintOptions(Options{});
  EXPECT_THAT(text, StartsWith("# Options of liod"));
  for (const std::string& line : Lines(text)) {
    if (line.empty()) continue;
    const std::size_t hash = line.rfind("# ");
    ASSERT_NE(hash, std::string::npos) << line;
    EXPECT_GT(line.size(), hash + 8) << line;
    // Comments are in one column if the value leaves room.
    const std::size_t end_of_value = line.find_last_not_of(' ', hash - (hash > 0 ? 1 : 0));
    if (hash > 0 && end_of_value < 38) {
      EXPECT_EQ(hash, 39u) << line;
    }
  }
}

TEST(OptionsPrint, BeamsStandAloneAsAFileThatFollowsTheRigs) {
  const std::string text = PrintBeams(test::TwoLidarBeams());
  EXPECT_THAT(text, StartsWith("# "));
  EXPECT_THAT(text, HasSubstr("\nrig:\n  lidar:\n    beams: "));
  EXPECT_EQ(ValueOf(text, "range_m"), "[0.012, -0.003]");
  EXPECT_EQ(ValueOf(text, "elevation_rad"), "[1.0e-08, -0.0002]");
  EXPECT_EQ(ValueOf(text, "encoder_std_rad"), "[4.0e-05, 5.0e-05]");
}

}  // namespace
}  // namespace lio
