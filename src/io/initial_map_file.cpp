// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/initial_map_file.hpp"

#include <fmt/format.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

enum class CloudKind { kOther, kPcd, kPly };

// The first word tells: both kinds of files begin with text.
CloudKind KindOfCloud(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string word;
  file >> word;
  if (word == "ply") return CloudKind::kPly;
  const bool is_pcd = word == "VERSION" || (word == "#" && (file >> word) && word == ".PCD");
  return is_pcd ? CloudKind::kPcd : CloudKind::kOther;
}

// PCL prints several lines for a damaged file and goes on; the error of ours is one line.
class QuietPcl {
 public:
  QuietPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

bool ReadCloud(const fs::path& path, CloudKind kind, pcl::PCLPointCloud2& cloud) {
  const QuietPcl quiet;
  try {
    return kind == CloudKind::kPcd ? pcl::PCDReader().read(path.string(), cloud) == 0
                                   : pcl::PLYReader().read(path.string(), cloud) == 0;
  } catch (const std::exception&) {
    return false;
  }
}

bool HasFloat(const pcl::PCLPointCloud2& cloud, const char* name) {
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [&](const auto& field) {
    return field.name == name && field.datatype == pcl::PCLPointField::FLOAT32;
  });
}

// Four finite numbers with commas between.
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
                 "With --initial-map: seek near this pose only, which may be wrong by 10 m, 1.5 m\n"
                 "in height and 30 deg; for places that look alike, such as storeys")
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
  const CloudKind kind = KindOfCloud(path);
  if (kind == CloudKind::kOther) throw fail("is neither a PCD nor a PLY file");
  pcl::PCLPointCloud2 raw;
  if (!ReadCloud(path, kind, raw)) throw fail("is damaged: it cannot be read as a point cloud");
  const std::uint64_t num_bytes = std::uint64_t{raw.width} * raw.height * raw.point_step;
  if (num_bytes != raw.data.size()) throw fail("is damaged: it ends before its last point");
  if (raw.data.empty()) throw fail("has no points");
  if (!HasFloat(raw, "x") || !HasFloat(raw, "y") || !HasFloat(raw, "z")) {
    throw fail("has no x, y and z as floats of 4 bytes");
  }
  pcl::PointCloud<pcl::PointXYZ> cloud;
  pcl::fromPCLPointCloud2(raw, cloud);
  std::vector<Eigen::Vector3f> points;
  points.reserve(cloud.size());
  for (const pcl::PointXYZ& p : cloud) {
    const Eigen::Vector3f point(p.x, p.y, p.z);
    if (point.allFinite()) points.push_back(point);
  }
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
