// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/scan_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "python/arrays.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

constexpr py::ssize_t kMostPoints = 4 << 20;  // the estimator takes no more in a sweep

Vector3 RowOf(const double* values) {
  return {values[0], values[1], values[2]};
}

void DemandSame(const char* what, std::size_t num, std::size_t num_wanted, const char* of) {
  if (num == num_wanted) return;
  throw py::value_error(
      fmt::format("{}: expects one for each of {} {}, not {}", what, num_wanted, of, num));
}

// Returns the column, or nothing for None.
std::vector<std::int64_t> TakeColumn(const py::object& given, const char* what, std::size_t num,
                                     std::int64_t most) {
  if (given.is_none()) return {};
  Integers column = TakeIntegers(given, what, 0, most);
  if (column.is_single) {
    throw py::value_error(fmt::format("{}: expects the shape (N,), not one integer", what));
  }
  DemandSame(what, column.values.size(), num, "points");
  return std::move(column.values);
}

// The stamp becomes that of the first point, as drivers and converters send it: in whole
// microseconds, so that a sweep which came over the wire stays as it is. The order of the points
// stays, since the last bits of an estimate depend on it.
void StampFirstPoint(ScanChunk& chunk) {
  if (chunk.points.empty()) return;
  constexpr std::uint32_t kMicrosecond_ns = 1000;
  std::uint32_t first = chunk.points.front().t_offset_ns;
  for (const LidarPoint& point : chunk.points) first = std::min(first, point.t_offset_ns);
  const std::uint32_t shift = first - first % kMicrosecond_ns;
  chunk.stamp = chunk.stamp + Duration{shift};
  for (LidarPoint& point : chunk.points) point.t_offset_ns -= shift;
}

template <typename Number>
void FillColumn(std::vector<LidarPoint>& points, Number LidarPoint::*member,
                const std::vector<std::int64_t>& column) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    points[i].*member = static_cast<Number>(column[i]);
  }
}

}  // namespace

std::vector<ImuSample> TakeSamples(const py::object& stamps, const py::object& gyro,
                                   const py::object& accel) {
  const Integers stamps_ns = TakeStamps(stamps, "stamp_ns");
  const Rows rates = TakeRows(gyro, "gyro", 3);
  const Rows forces = TakeRows(accel, "accel", 3);
  if (rates.is_single != stamps_ns.is_single || forces.is_single != stamps_ns.is_single) {
    throw py::value_error(
        "stamp_ns, gyro and accel: expects one stamp with two vectors, or N stamps with two arrays "
        "of the shape (N, 3)");
  }
  std::vector<ImuSample> samples(stamps_ns.values.size());
  DemandSame("gyro", static_cast<std::size_t>(rates.num_rows), samples.size(), "stamps");
  DemandSame("accel", static_cast<std::size_t>(forces.num_rows), samples.size(), "stamps");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].stamp = Timestamp{stamps_ns.values[i]};
    samples[i].w_imu_radps = RowOf(rates.values.data() + 3 * i);
    samples[i].f_imu_mps2 = RowOf(forces.values.data() + 3 * i);
  }
  return samples;
}

ScanChunk TakeScan(const py::object& stamp, const py::object& points, const py::object& times,
                   const py::object& rings, const py::object& intensity) {
  constexpr std::int64_t kMostTime_ns = 1'000'000'000;  // the estimator refuses half of it
  constexpr std::int64_t kMost16 = std::numeric_limits<std::uint16_t>::max();
  const Integers stamp_ns = TakeStamps(stamp, "stamp_ns");
  if (!stamp_ns.is_single) throw py::value_error("stamp_ns: expects one integer");
  const Rows rows = TakeRows(points, "points", 3);
  if (rows.is_single) throw py::value_error("points: expects the shape (N, 3), not (3,)");
  if (rows.num_rows > kMostPoints) {
    throw py::value_error(fmt::format("points: expects at most {}", kMostPoints));
  }
  ScanChunk chunk;
  chunk.stamp = Timestamp{stamp_ns.values.front()};
  chunk.points.resize(static_cast<std::size_t>(rows.num_rows));
  for (std::size_t i = 0; i < chunk.points.size(); ++i) {
    const double* point = rows.values.data() + 3 * i;
    chunk.points[i].x_m = static_cast<float>(point[0]);
    chunk.points[i].y_m = static_cast<float>(point[1]);
    chunk.points[i].z_m = static_cast<float>(point[2]);
  }
  const std::size_t num = chunk.points.size();
  FillColumn(chunk.points, &LidarPoint::t_offset_ns,
             TakeColumn(times, "times_ns", num, kMostTime_ns));
  FillColumn(chunk.points, &LidarPoint::ring, TakeColumn(rings, "rings", num, kMost16));
  FillColumn(chunk.points, &LidarPoint::intensity,
             TakeColumn(intensity, "intensity", num, kMost16));
  StampFirstPoint(chunk);
  return chunk;
}

}  // namespace lio::python
