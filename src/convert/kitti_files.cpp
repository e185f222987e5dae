// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "convert/sweep_to_chunks.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

constexpr int kNumBeams = 64;  // HDL-64E
constexpr float kReflectanceScale = 255.0f;

// Parses a whole number of exactly `digits` digits at `at`.
std::optional<int> Digits(std::string_view text, std::size_t at, std::size_t digits) {
  int value = 0;
  if (at + digits > text.size()) return {};
  const char* begin = text.data() + at;
  const auto parsed = std::from_chars(begin, begin + digits, value);
  if (parsed.ec != std::errc() || parsed.ptr != begin + digits || value < 0) return {};
  return value;
}

std::vector<std::array<float, 4>> ReadBinary(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  constexpr std::size_t kPointBytes = sizeof(std::array<float, 4>);
  constexpr std::uintmax_t kMaxBytes = 1 << 26;  // 4 M points, thirty times what KITTI has
  if (error || size % kPointBytes != 0 || size > kMaxBytes) return {};
  std::vector<std::array<float, 4>> points(size / kPointBytes);
  RefuseIrregular(file);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(points.data()), static_cast<std::streamsize>(size));
  if (!stream) points.clear();
  return points;
}

std::vector<std::array<float, 4>> ReadText(const std::filesystem::path& file) {
  RefuseIrregular(file);
  std::ifstream stream(file);
  std::vector<std::array<float, 4>> points;
  std::array<float, 4> point;
  while (stream >> point[0] >> point[1] >> point[2] >> point[3]) points.push_back(point);
  if (!stream.eof()) points.clear();
  return points;
}

}  // namespace

std::optional<Timestamp> ParseKittiStamp(std::string_view line) {
  using namespace std::chrono;
  const auto year_number = Digits(line, 0, 4);
  const auto month_number = Digits(line, 5, 2);
  const auto day_number = Digits(line, 8, 2);
  const auto hour = Digits(line, 11, 2);
  const auto minute = Digits(line, 14, 2);
  const auto second = Digits(line, 17, 2);
  if (!year_number || !month_number || !day_number || !hour || !minute || !second) return {};
  const year_month_day date{year{*year_number}, month{static_cast<unsigned>(*month_number)},
                            day{static_cast<unsigned>(*day_number)}};
  // Nanoseconds of 64 bits end in 2262, and there were no drives before 1970.
  if (*year_number < 1970 || *year_number > 2261) return {};
  if (!date.ok() || *hour > 23 || *minute > 59 || *second > 60) return {};
  const std::string_view fraction_text = line.substr(19);
  std::int64_t fraction_ns = 0;
  if (!fraction_text.empty()) {
    const auto fraction = ParseStamp("0" + std::string(fraction_text));
    if (fraction_text.front() != '.' || !fraction) return {};
    fraction_ns = fraction->ns;
  }
  const std::int64_t days = sys_days(date).time_since_epoch().count();
  const std::int64_t seconds = ((days * 24 + *hour) * 60 + *minute) * 60 + *second;
  return Timestamp{seconds * 1'000'000'000 + fraction_ns};
}

std::vector<Timestamp> ReadKittiStamps(const std::filesystem::path& file) {
  RefuseIrregular(file);
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  std::vector<Timestamp> stamps;
  std::string line;
  while (std::getline(stream, line)) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    const auto stamp = ParseKittiStamp(line);
    if (!stamp) {
      throw InputError(file.string() + ":" + std::to_string(stamps.size() + 1) +
                       ": no time stamp like 2011-09-26 13:04:32.349659964");
    }
    stamps.push_back(*stamp);
  }
  return stamps;
}

std::map<std::string, std::vector<double>> ReadKittiCalibration(const std::filesystem::path& file) {
  RefuseIrregular(file);
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  std::map<std::string, std::vector<double>> rows;
  std::string line;
  while (std::getline(stream, line)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 1));
    std::vector<double>& numbers = rows[line.substr(0, colon)];
    double number = 0.0;
    while (words >> number) numbers.push_back(number);
  }
  return rows;
}

Pose ToPose(const std::vector<double>& rotation_row_major, const std::vector<double>& translation,
            const std::string& what) {
  constexpr double kMaxError = 1e-3;  // KITTI's numbers are good to 1e-6
  if (rotation_row_major.size() == 9 && translation.size() == 3) {
    const Matrix3 R =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation_row_major.data());
    const Matrix3 error = R * R.transpose() - Matrix3::Identity();
    if (error.norm() < kMaxError && R.determinant() > 0.0) {
      return {Quaternion(R).normalized(), Vector3(translation[0], translation[1], translation[2])};
    }
  }
  throw InputError(what + ": needs nine numbers of a rotation and three of a translation");
}

std::optional<std::vector<LidarPoint>> ReadKittiScan(const std::filesystem::path& file) {
  const auto raw = file.extension() == ".txt" ? ReadText(file) : ReadBinary(file);
  std::vector<LidarPoint> points;
  points.reserve(raw.size());
  for (const auto& [x, y, z, reflectance] : raw) {
    const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    if (!finite || (x == 0.0f && y == 0.0f && z == 0.0f)) continue;
    points.push_back({.x_m = x,
                      .y_m = y,
                      .z_m = z,
                      .intensity = QuantiseIntensity(kReflectanceScale * reflectance)});
  }
  if (points.empty()) return {};
  AssignKittiRings(points);
  return points;
}

void AssignKittiRings(std::vector<LidarPoint>& points) {
  int ring = kNumBeams - 1;
  bool has_turned = false;  // the ring has passed the rear on the car's right side
  for (LidarPoint& point : points) {
    const float azimuth = std::atan2(point.y_m, point.x_m);
    constexpr float kQuarter = static_cast<float>(std::numbers::pi / 2.0);
    if (has_turned && azimuth >= 0.0f && azimuth < kQuarter) {
      ring = std::max(0, ring - 1);
      has_turned = false;
    }
    has_turned |= azimuth < -kQuarter * 0.1f;
    point.ring = static_cast<std::uint16_t>(ring);
  }
}

std::filesystem::path WholePath(const std::filesystem::path& folder) {
  return (std::filesystem::absolute(folder) / "").lexically_normal().parent_path();
}

std::map<int, std::filesystem::path> NumberedFiles(const std::filesystem::path& folder) {
  std::map<int, std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string stem = entry.path().stem().string();
    const std::string extension = entry.path().extension().string();
    int number = 0;
    const auto parsed = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    const bool is_number = parsed.ec == std::errc() && parsed.ptr == stem.data() + stem.size();
    if (is_number && number >= 0 && (extension == ".bin" || extension == ".txt")) {
      files[number] = entry.path();
    }
  }
  return files;
}

}  // namespace lio
