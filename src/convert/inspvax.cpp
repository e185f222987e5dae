// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/inspvax.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr std::int64_t kGpsEpochUnix = 315'964'800;  // 1980-01-06 00:00:00 UTC
constexpr std::int64_t kWeekSeconds = 604'800;

// Returns the first of these fields that exists.
std::optional<double> Find(const RosNumbers& numbers,
                           std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = numbers.find(name);
    if (found != numbers.end() && std::isfinite(found->second)) return found->second;
  }
  return {};
}

// Reads a status that has four bytes or one field.
std::optional<double> FindStatus(const RosNumbers& numbers) {
  const auto status = Find(numbers, {"ins_status.status", "ins_status", "status"});
  if (status) return status;
  double value = 0.0;
  for (int i = 3; i >= 0; --i) {
    const auto byte =
        Find(numbers, {fmt::format("status[{}]", i), fmt::format("ins_status[{}]", i)});
    if (!byte) return {};
    value = 256.0 * value + *byte;
  }
  return value;
}

Timestamp FromGps(double week, double seconds_of_week) {
  const auto weeks_s = static_cast<std::int64_t>(week) * kWeekSeconds;
  const auto whole_s = static_cast<std::int64_t>(seconds_of_week);
  const std::int64_t leap_s = LeapSeconds(weeks_s + whole_s);
  return Timestamp{(weeks_s + kGpsEpochUnix - leap_s) * 1'000'000'000} +
         Duration::FromSeconds(seconds_of_week);
}

// Some drivers name a field of milliseconds "gps_week_seconds", so the unit that puts the stamp
// nearer to the row's receive time is used.
std::optional<Timestamp> FindStamp(const RosNumbers& numbers, Timestamp received) {
  const auto week =
      Find(numbers, {"nov_header.gps_week_number", "header.gps_week", "header.week", "gps_week"});
  const auto of_week = Find(numbers, {"nov_header.gps_week_milliseconds", "header.gps_week_seconds",
                                      "header.gpssec", "gps_week_seconds", "gps_seconds"});
  if (!week || !of_week || *week < 0 || *week > 1e4 || *of_week < 0) return {};
  const double limit = static_cast<double>(kWeekSeconds);
  std::optional<Timestamp> best;
  for (const double seconds : {1e-3 * *of_week, *of_week}) {
    if (seconds > limit) continue;
    const Timestamp stamp = FromGps(*week, seconds);
    const auto distance = [&](Timestamp t) { return std::abs(SecondsBetween(t, received)); };
    if (!best || distance(stamp) < distance(*best)) best = stamp;
  }
  return best;
}

Vector3 ToEcef(double latitude_rad, double longitude_rad, double height_m) {
  constexpr double kSemiMajor = 6'378'137.0;  // WGS84
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricitySq = kFlattening * (2.0 - kFlattening);
  const double sin_latitude = std::sin(latitude_rad);
  const double normal = kSemiMajor / std::sqrt(1.0 - kEccentricitySq * sin_latitude * sin_latitude);
  const double across = (normal + height_m) * std::cos(latitude_rad);
  return {across * std::cos(longitude_rad), across * std::sin(longitude_rad),
          (normal * (1.0 - kEccentricitySq) + height_m) * sin_latitude};
}

constexpr const char* kOem7Definition = R"(Header header
Oem7Header nov_header
InertialSolutionStatus ins_status
PositionOrVelocityType pos_type
float64 latitude
float64 longitude
float64 height
float32 undulation
float64 north_velocity
float64 east_velocity
float64 up_velocity
float64 roll
float64 pitch
float64 azimuth
float32[9] stdevs
INSExtendedSolutionStatus ext_sol_status
uint16 time_since_update
===
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
===
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
===
MSG: novatel_oem7_msgs/Oem7Header
string message_name
uint16 message_id
uint8 message_type
uint32 sequence_number
uint8 time_status
uint16 gps_week_number
uint32 gps_week_milliseconds
===
MSG: novatel_oem7_msgs/InertialSolutionStatus
uint32 status
===
MSG: novatel_oem7_msgs/PositionOrVelocityType
uint32 type
===
MSG: novatel_oem7_msgs/INSExtendedSolutionStatus
uint32 status
)";

}  // namespace

std::optional<InspvaxRow> ToInspvaxRow(const RosNumbers& numbers, Timestamp received) {
  const auto stamp = FindStamp(numbers, received);
  const auto status = FindStatus(numbers);
  const auto latitude = Find(numbers, {"latitude"});
  const auto longitude = Find(numbers, {"longitude"});
  const auto height = Find(numbers, {"height", "altitude"});
  const auto roll = Find(numbers, {"roll"});
  const auto pitch = Find(numbers, {"pitch"});
  const auto azimuth = Find(numbers, {"azimuth"});
  if (!stamp || !status || !latitude || !longitude || !height || !roll || !pitch || !azimuth) {
    return {};
  }
  if (std::abs(*latitude) > 90.0 || std::abs(*longitude) > 360.0) return {};
  InspvaxRow row;
  row.stamp = *stamp;
  row.ins_status = std::abs(*status) < 1e6 ? static_cast<int>(*status) : -1;
  row.latitude_rad = *latitude * kRadPerDeg;
  row.longitude_rad = *longitude * kRadPerDeg;
  row.ellipsoid_height_m = *height + Find(numbers, {"undulation"}).value_or(0.0);
  row.roll_rad = *roll * kRadPerDeg;
  row.pitch_rad = *pitch * kRadPerDeg;
  row.azimuth_rad = *azimuth * kRadPerDeg;
  return row;
}

const char* KnownInspvaxDefinition(std::string_view type) {
  return type == "novatel_oem7_msgs/INSPVAX" ? kOem7Definition : nullptr;
}

int LeapSeconds(std::int64_t gps_s) {
  struct Step {
    std::int64_t from_gps_s;
    int leap_s;
  };
  // The steps are from IERS Bulletin C; the instants are the new offsets' beginnings in GPS time.
  constexpr std::array<Step, 5> kSteps = {{{1'167'264'018, 18},  // 2017-01-01
                                           {1'119'744'017, 17},  // 2015-07-01
                                           {1'025'136'016, 16},  // 2012-07-01
                                           {914'803'215, 15},    // 2009-01-01
                                           {820'108'814, 14}}};  // 2006-01-01
  for (const Step& step : kSteps) {
    if (gps_s >= step.from_gps_s) return step.leap_s;
  }
  return 13;
}

Quaternion InspvaxAttitude(double roll_rad, double pitch_rad, double azimuth_rad) {
  using Eigen::AngleAxisd;
  return Quaternion(AngleAxisd(-azimuth_rad, Vector3::UnitZ()) *
                    AngleAxisd(pitch_rad, Vector3::UnitX()) *
                    AngleAxisd(roll_rad, Vector3::UnitY()));
}

Vector3 LocalFrame::ToLocal(double latitude_rad, double longitude_rad, double ellipsoid_height_m) {
  const Vector3 ecef = ToEcef(latitude_rad, longitude_rad, ellipsoid_height_m);
  if (!origin_ecef_m_) {
    origin_ecef_m_ = ecef;
    const double sin_lat = std::sin(latitude_rad);
    const double cos_lat = std::cos(latitude_rad);
    const double sin_lon = std::sin(longitude_rad);
    const double cos_lon = std::cos(longitude_rad);
    R_enu_ecef_ << -sin_lon, cos_lon, 0.0,                // east
        -sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat,  // north
        cos_lat * cos_lon, cos_lat * sin_lon, sin_lat;    // up
  }
  return R_enu_ecef_ * (ecef - *origin_ecef_m_);
}

}  // namespace lio
