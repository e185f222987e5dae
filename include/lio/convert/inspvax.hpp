// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the truth from NovAtel's INSPVAX log (GNSS/INS position, velocity, attitude): poses of the
// receiver's body (x right, y forward, z up) in a local east-north-up frame whose origin is the
// first good fix.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lio/convert/bag_reader.hpp"
#include "lio/convert/ros_schema.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

struct InspvaxRow {
  Timestamp stamp;     // UTC, from GPS week and time of week minus the leap seconds
  int ins_status = 0;  // 3: the solution is good
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double ellipsoid_height_m = 0.0;  // height above sea level plus undulation
  double roll_rad = 0.0;            // about y (forward), NovAtel's convention
  double pitch_rad = 0.0;           // about x (right)
  double azimuth_rad = 0.0;         // clockwise from north
};

inline constexpr int kInsSolutionGood = 3;

// Finds the row's fields by name, for the variants of novatel_oem7_msgs, novatel_msgs and UrbanNav.
// `received` decides whether a time of week is in seconds or in milliseconds. Returns nothing when
// a field is missing or out of range.
[[nodiscard]] std::optional<InspvaxRow> ToInspvaxRow(const RosNumbers& numbers, Timestamp received);

// Returns the definition that a ROS 2 bag without definitions needs; null for unknown types.
[[nodiscard]] const char* KnownInspvaxDefinition(std::string_view type);

// Returns GPS minus UTC [s] at a GPS time [s since the GPS epoch, 1980-01-06].
[[nodiscard]] int LeapSeconds(std::int64_t gps_s);

// Returns R_enu_body = Rz(-azimuth) Rx(pitch) Ry(roll).
[[nodiscard]] Quaternion InspvaxAttitude(double roll_rad, double pitch_rad, double azimuth_rad);

// Converts positions on WGS84 to the east-north-up frame at the first position.
class LocalFrame {
 public:
  [[nodiscard]] Vector3 ToLocal(double latitude_rad, double longitude_rad,
                                double ellipsoid_height_m);

 private:
  std::optional<Vector3> origin_ecef_m_;
  Matrix3 R_enu_ecef_ = Matrix3::Identity();
};

}  // namespace lio
