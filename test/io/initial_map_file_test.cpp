// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/initial_map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/pcd_file.hpp"
#include "lio/io/ply_file.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Points = std::vector<Eigen::Vector3f>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Points SomePoints() {
  Points points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.1f * static_cast<float>(i), 2.f, -3.f);
  return points;
}

std::string ErrorOf(const fs::path& path) {
  try {
    static_cast<void>(LoadMapPoints(path));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class InitialMapFile : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return dir_.path() / name; }

  // Expects an error in one line that names the file.
  void ExpectRefused(const fs::path& file, const std::string& why) const {
    const std::string error = ErrorOf(file);
    EXPECT_THAT(error, AllOf(HasSubstr(file.string()), HasSubstr(why)));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }

  const test::TempDir dir_;
};

TEST_F(InitialMapFile, BothFormatsOfOursAreRead) {
  const Points points = SomePoints();
  WritePcd(path("map.pcd"), points);
  WritePly(path("map.ply"), points);
  EXPECT_EQ(LoadMapPoints(path("map.pcd")), points);
  EXPECT_EQ(LoadMapPoints(path("map.ply")), points);
}

TEST_F(InitialMapFile, TextAndOtherFieldsAreReadAndPointsWithoutNumbersLeftOut) {
  const fs::path file =
      dir_.Write("other.pcd",
                 "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\n"
                 "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"
                 "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ascii\n1 2 3 9\nnan 2 3 9\n4 5 6 9\n");
  EXPECT_EQ(LoadMapPoints(file), (Points{{1.f, 2.f, 3.f}, {4.f, 5.f, 6.f}}));
}

TEST_F(InitialMapFile, MissingFilesAndFilesOfOtherKindsAreNamed) {
  ExpectRefused(path("missing.pcd"), "does not exist");
  ExpectRefused(dir_.path(), "is neither a PCD nor a PLY file");
  ExpectRefused(dir_.Write("empty.pcd", ""), "is neither a PCD nor a PLY file");
  ExpectRefused(dir_.Write("text.pcd", "these are not points\n"), "is neither");
}

TEST_F(InitialMapFile, DamagedFilesAreNamed) {
  for (const std::string name : {"map.pcd", "map.ply"}) {
    if (name == "map.pcd") WritePcd(path(name), SomePoints());
    if (name == "map.ply") WritePly(path(name), SomePoints());
    const std::string whole = test::ReadText(path(name));
    for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{120}}) {
      const fs::path cut = dir_.Write("cut_" + name, whole.substr(0, length));
      ExpectRefused(cut, "damaged");
    }
  }
  ExpectRefused(dir_.Write("header.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"), "");
}

TEST_F(InitialMapFile, CloudsThatNobodyCanStartInAreNamed) {
  WritePcd(path("none.pcd"), {});
  ExpectRefused(path("none.pcd"), "has no points");
  WritePly(path("none.ply"), {});
  ExpectRefused(path("none.ply"), "no points");
  WritePcd(path("nan.pcd"), Points(20, Eigen::Vector3f::Constant(kNan)));
  ExpectRefused(path("nan.pcd"), "has no points");
  WritePcd(path("far.pcd"), Points{{500e3f, 4500e3f, 0.f}});
  ExpectRefused(path("far.pcd"), "from its origin");
  WritePcd(path("wide.pcd"), Points{{0.f, 0.f, 0.f}, {0.f, 9000.f, 0.f}});
  ExpectRefused(path("wide.pcd"), "9.0 km wide");
  ExpectRefused(dir_.Write("flat.pcd",
                           "VERSION 0.7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\n"
                           "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2\n"),
                "has no x, y and z");
}

std::optional<int> Load(const InitialMapArguments& arguments, const Options& options,
                        InitialMapPtr& map) {
  testing::internal::CaptureStderr();
  const auto code = LoadInitialMap("program", arguments, options, map);
  const std::string text = testing::internal::GetCapturedStderr();
  if (code) {
    EXPECT_THAT(text, HasSubstr("program: --initial-map"));
  } else {
    EXPECT_EQ(text, "");
  }
  return code;
}

TEST_F(InitialMapFile, ExitCodesAreThoseOfTheContract) {
  InitialMapPtr map;
  EXPECT_FALSE(Load({}, {}, map)) << "none was asked for";
  EXPECT_FALSE(map);
  EXPECT_EQ(Load({path("missing.pcd"), ""}, {}, map), kExitUnusableInput);
  WritePcd(path("map.pcd"), SomePoints());
  Options other;
  other.pipeline.method = MatchMethod::kGicp;
  EXPECT_EQ(Load({path("map.pcd"), ""}, other, map), kExitConfiguration);
  other = {};
  other.pipeline.use_imu = false;
  EXPECT_EQ(Load({path("map.pcd"), ""}, other, map), kExitConfiguration);
  EXPECT_FALSE(map);
  EXPECT_FALSE(Load({path("map.pcd"), "1,-2,3,90"}, {}, map));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->points.size(), 1000u);
  ASSERT_TRUE(map->guess);
  EXPECT_EQ(map->guess->position_m, Vector3(1.0, -2.0, 3.0));
  EXPECT_NEAR(map->guess->yaw_rad, 1.5708, 1e-4);
}

TEST_F(InitialMapFile, PoseIsFourNumbersAndNeedsAMap) {
  const auto parse = [](std::vector<const char*> words) {
    CLI::App app("", "program");
    InitialMapArguments arguments;
    AddInitialMapArguments(app, arguments);
    words.insert(words.begin(), "program");
    testing::internal::CaptureStderr();
    const auto code = ParseCommandLine(app, static_cast<int>(words.size()), words.data(), "0");
    static_cast<void>(testing::internal::GetCapturedStderr());
    return std::pair(code, arguments);
  };
  const auto [code, arguments] =
      parse({"--initial-map", "m.pcd", "--initial-pose", "-1.5,2,0,-90"});
  EXPECT_FALSE(code);
  EXPECT_EQ(arguments.pose, "-1.5,2,0,-90");
  EXPECT_EQ(parse({"--initial-pose", "1,2,0,90"}).first, kExitUsage);
  EXPECT_EQ(parse({"--initial-map", "m.pcd", "--initial-pose", "1,2,0"}).first, kExitUsage);
  EXPECT_EQ(parse({"--initial-map", "m.pcd", "--initial-pose", "1,2,nan,0"}).first, kExitUsage);
}

}  // namespace
}  // namespace lio
