// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "ouster_metadata.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "lio/base/angle.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxBeams = 256, kMaxColumns = 4096, kMaxPerPacket = 64;
constexpr int kMaxDepth = 8;  // sections in sections; the drivers' files have two

// Finds a key in any of the sections: files of different ages nest it differently.
const Json& Find(const Json& all, const std::string& key, int depth = 0) {
  static const Json nothing;
  if (all.contains(key)) return all[key];
  for (const auto& section : all) {
    if (!section.is_object() || depth == kMaxDepth) continue;
    const Json& found = Find(section, key, depth + 1);
    if (!found.is_null()) return found;
  }
  return nothing;
}

std::vector<double> Angles(const Json& all, const std::string& key) {
  auto angles = Find(all, key).get<std::vector<double>>();
  for (double& angle : angles) angle *= kRadPerDeg;
  return angles;
}

// Reads a list of 16 numbers, row by row, lengths in mm; the identity where it is missing.
Pose TransformOf(const Json& all, const std::string& key) {
  const Json& found = Find(all, key);
  if (found.is_null()) return Pose::Identity();
  const auto m = found.get<std::vector<double>>();
  if (m.size() != 16) throw InputError(key + " has not 16 numbers");
  Eigen::Matrix3d R;
  R << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  Pose pose;
  pose.rotation = Quaternion(R).normalized();
  pose.translation = kMetresPerMillimetre * Vector3(m[3], m[7], m[11]);
  return pose;
}

OusterProfile ProfileOf(const Json& all) {
  const Json& named = Find(all, "udp_profile_lidar");
  const std::string name = named.is_null() ? "LEGACY" : named.get<std::string>();
  if (name == "LEGACY") return OusterProfile::kLegacy;
  if (name == "RNG19_RFL8_SIG16_NIR16") return OusterProfile::kRng19;
  throw InputError("profile " + name + " is not supported: LEGACY and RNG19_RFL8_SIG16_NIR16 are");
}

// The mode "1024x10" has columns of a turn, then turns a second.
std::size_t ColumnsOfMode(const Json& all) {
  return std::stoul(Find(all, "lidar_mode").get<std::string>());
}

// Numbers of other kinds may be too large for a count.
std::size_t CountOf(const Json& found, const std::string& key) {
  if (!found.is_number_unsigned()) throw InputError(key + " is no whole number");
  return found.get<std::size_t>();
}

OusterMetadata Parse(const Json& all) {
  OusterMetadata sensor;
  sensor.profile = ProfileOf(all);
  sensor.elevation_rad = Angles(all, "beam_altitude_angles");
  sensor.azimuth_offset_rad = Angles(all, "beam_azimuth_angles");
  const Json& columns = Find(all, "columns_per_frame");
  sensor.columns_per_turn =
      columns.is_null() ? ColumnsOfMode(all) : CountOf(columns, "columns_per_frame");
  const Json& per_packet = Find(all, "columns_per_packet");
  if (!per_packet.is_null()) sensor.columns_per_packet = CountOf(per_packet, "columns_per_packet");
  const Json& origin = Find(all, "lidar_origin_to_beam_origin_mm");
  if (!origin.is_null()) sensor.beam_origin_m = kMetresPerMillimetre * origin.get<double>();
  sensor.T_sensor_lidar = TransformOf(all, "lidar_to_sensor_transform");
  sensor.T_sensor_imu = TransformOf(all, "imu_to_sensor_transform");
  const std::size_t beams = sensor.elevation_rad.size();
  if (beams == 0 || beams > kMaxBeams || sensor.azimuth_offset_rad.size() != beams ||
      sensor.columns_per_turn == 0 || sensor.columns_per_turn > kMaxColumns ||
      sensor.columns_per_packet == 0 || sensor.columns_per_packet > kMaxPerPacket) {
    throw InputError("beams and columns do not fit together");
  }
  return sensor;
}

}  // namespace

std::size_t OusterMetadata::PacketBytes() const {
  const std::size_t pixels = kOusterPixelBytes * elevation_rad.size();
  return profile == OusterProfile::kLegacy ? columns_per_packet * (16 + pixels + 4)
                                           : 32 + columns_per_packet * (12 + pixels) + 32;
}

OusterMetadata ReadOusterMetadata(const std::filesystem::path& file) {
  std::ifstream stream(file);
  try {
    return Parse(Json::parse(stream));
  } catch (const std::exception& error) {
    throw InputError(file.string() + ": no description of an Ouster sensor: " + error.what());
  }
}

}  // namespace lio
