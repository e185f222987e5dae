// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds where a PointCloud2 keeps the values of a lidar point, by field name, type and offset, so
// that every driver's layout is read, with double precision for times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/convert/ros_messages.hpp"

namespace lio {

struct PointLayout {
  CloudField x, y, z;                   // metres, float32 or float64
  std::optional<CloudField> intensity;  // "intensity", else "reflectivity", "i"
  std::optional<CloudField> ring;       // "ring", else "channel", "line", "laser_id"
  std::optional<CloudField> tag;        // "tag" as uint8, Livox's judgement of the point
  std::optional<CloudField> time;  // "time", "t", "timestamp", "time_stamp", "offset_time", "ts"
};

// Returns nothing when x, y or z is missing or not floating point.
[[nodiscard]] std::optional<PointLayout> FindLayout(const std::vector<CloudField>& fields);

// Holds the points of one cloud as columns, in the message's order. Points that are not finite, at
// the origin (a driver's "no return"), without finite time or tagged as noise are left out.
struct CloudPoints {
  std::vector<float> x_m, y_m, z_m;  // lidar frame
  std::vector<float> intensity;      // 0 if the source has none
  std::vector<std::int32_t> ring;    // as the source numbers them; empty without a ring field
  std::vector<double> time;          // in the source's unit; empty without a time field
  std::vector<std::uint32_t> row;    // row in an organised cloud; empty for height 1
  std::vector<std::uint32_t> column;
  std::int64_t num_nonfinite = 0;
  std::int64_t num_zero = 0;   // points without return
  std::int64_t num_noise = 0;  // points that the sensor's tag calls noise

  [[nodiscard]] std::size_t size() const { return x_m.size(); }
};

// Reuses the memory of `points`. `layout` must come from this cloud's fields.
void ReadPoints(const RosCloud& cloud, const PointLayout& layout, CloudPoints& points);

// Returns e.g. "x y z intensity ring(uint16) time(float32)", for the user.
[[nodiscard]] std::string DescribeFields(const std::vector<CloudField>& fields);

}  // namespace lio
