// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/initial_map_file.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "cloud_file.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

bool HasFloat(const pcl::PCLPointCloud2& cloud, const char* name) {
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [&](const auto& field) {
    return field.name == name && field.datatype == pcl::PCLPointField::FLOAT32;
  });
}

// Reads four finite numbers with commas between.
std::optional<std::array<double, 4>> ParsePose(const std::string& text) {
  std::array<double, 4> pose{};
  const char* at = text.data();
  const char* end = at + text.size();
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const auto [stop, error] = std::from_chars(at, end, pose[i]);
    if (error != std::errc() || !std::isfinite(pose[i])) return std::nullopt;
    const bool is_last = i + 1 == pose.size();
    if (is_last ? stop != end : stop == end || *stop != ',') return std::nullopt;
    at = stop + 1;
  }
  return pose;
}

}  // namespace

void AddInitialMapArguments(CLI::App& app, InitialMapArguments& arguments) {
  app.add_option("--initial-map", arguments.map,
                 "Start in this map: a map.pcd or map.ply of an earlier run, or any PCD or PLY of "
                 "x y z in\n"
                 "metres whose z is up. Until the place in it is found, no pose is given; from "
                 "then on all\n"
                 "poses are in the map's frame, and scans extend it (pipeline.map_locked: true "
                 "keeps it as\n"
                 "it is). Needs pipeline.method: ndt and an IMU")
      ->type_name("MAP");
  app.add_option("--initial-pose", arguments.pose,
                 "Seek near this pose only, which may be wrong by 10 m, 1.5 m in height and\n"
                 "30 deg; for places that look alike, such as storeys. Needs --initial-map")
      ->type_name("X,Y,Z,YAW_DEG")
      ->needs("--initial-map")
      ->check([](const std::string& text) {
        return ParsePose(text) ? ""
                               : "expects four numbers with commas between, not '" + text + "'";
      });
}

std::vector<Eigen::Vector3f> LoadMapPoints(const fs::path& path) {
  const auto fail = [&](const std::string& why) {
    return InputError(fmt::format("{} {}", path.string(), why));
  };
  if (!fs::exists(path)) throw fail("does not exist");
  RefuseIrregular(path);
  const CloudKind kind = KindOfCloud(path);
  if (kind == CloudKind::kOther) throw fail("is neither a PCD nor a PLY file");
  const std::optional<pcl::PCLPointCloud2> cloud = ReadCloud(path, kind);
  if (!cloud) throw fail("is damaged: it cannot be read as a point cloud");
  const std::uint64_t num_bytes = std::uint64_t{cloud->width} * cloud->height * cloud->point_step;
  if (num_bytes != cloud->data.size()) throw fail("is damaged: it ends before its last point");
  if (cloud->data.empty()) throw fail("has no points");
  if (!HasFloat(*cloud, "x") || !HasFloat(*cloud, "y") || !HasFloat(*cloud, "z")) {
    throw fail("has no x, y and z as floats of 4 bytes");
  }
  std::vector<Eigen::Vector3f> points = PointsOf(*cloud);
  std::erase_if(points, [](const Eigen::Vector3f& point) { return !point.allFinite(); });
  if (const std::string why = WhyUnusable(points); !why.empty()) throw fail(why);
  return points;
}

std::optional<int> LoadInitialMap(const std::string& program, const InitialMapArguments& arguments,
                                  const Options& options, InitialMapPtr& map) {
  if (arguments.map.empty()) return std::nullopt;
  if (options.pipeline.method != MatchMethod::kNdt || !options.pipeline.use_imu) {
    fmt::print(stderr, "{}: --initial-map needs pipeline.method: ndt and pipeline.use_imu: true\n",
               program);
    return kExitConfiguration;
  }
  InitialMap loaded;
  try {
    loaded.points = LoadMapPoints(arguments.map);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: --initial-map: {}\n", program, error.what());
    return kExitUnusableInput;
  }
  if (const auto pose = ParsePose(arguments.pose)) {
    const auto& [x_m, y_m, z_m, yaw_deg] = *pose;
    loaded.guess = {{x_m, y_m, z_m}, yaw_deg * std::numbers::pi / 180.0};
  }
  map = std::make_shared<const InitialMap>(std::move(loaded));
  return std::nullopt;
}

}  // namespace lio
