// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes clouds in the point layouts of common drivers.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "support/spinning_lidar.hpp"

namespace lio::test {

// Describes how a driver publishes the sweeps of the spinning lidar.
struct Driver {
  std::string name;
  std::vector<CloudField> fields = {};
  std::uint32_t point_step = 0;
  // Stores the time of a point; `start` is the instant of the sweep's first point.
  std::function<void(TestCloud&, std::size_t, const SeenPoint&, Timestamp start)> store_time = {};
  bool stamp_is_end = false;
  bool organised = false;      // rows are rings, the highest first; some points NaN
  bool ring_from_top = false;  // the ring field counts from the top
  bool shuffled = false;
  bool has_ring = true;
  double time_tolerance_s = 1e-7;
};

// Tells GoogleTest how to print a parameter.
inline void PrintTo(const Driver& driver, std::ostream* out) {
  *out << driver.name;
}

inline std::vector<CloudField> Fields(std::vector<CloudField> more) {
  std::vector<CloudField> fields = {Field("x", 0, FieldType::kFloat32),
                                    Field("y", 4, FieldType::kFloat32),
                                    Field("z", 8, FieldType::kFloat32)};
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

inline auto InUnits(const std::string& field, double per_second) {
  return [=](TestCloud& cloud, std::size_t i, const SeenPoint& point, Timestamp) {
    cloud.Set(i, field, per_second * point.time_s);
  };
}
// A double of this epoch steps by 0.24 us, and is rounded here three times.
inline constexpr double kAbsoluteTolerance = 4e-7;
inline auto Absolute(const std::string& field) {
  return [=](TestCloud& cloud, std::size_t i, const SeenPoint& point, Timestamp start) {
    cloud.Set(i, field, 1e-9 * static_cast<double>(start.ns) + point.time_s);
  };
}
inline void NoTime(TestCloud&, std::size_t, const SeenPoint&, Timestamp) {}

inline const CloudField kIntensity = Field("intensity", 12, FieldType::kFloat32);

inline std::vector<Driver> Drivers() {
  std::vector<Driver> drivers;
  drivers.push_back({.name = "VelodyneSeconds",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 18, FieldType::kFloat32)}),
                     .point_step = 22,
                     .store_time = InUnits("time", 1.0),
                     .time_tolerance_s = 1e-8});
  drivers.push_back({.name = "VelodyneMicrosecondsFloat",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 20, FieldType::kFloat32)}),
                     .point_step = 24,
                     .store_time = InUnits("time", 1e6)});
  drivers.push_back({.name = "VelodyneMicrosecondsDouble",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 24, FieldType::kFloat64)}),
                     .point_step = 32,
                     .store_time = InUnits("time", 1e6)});
  drivers.push_back({.name = "VelodyneMicrosecondsUint",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 20, FieldType::kUint32)}),
                     .point_step = 24,
                     .store_time = InUnits("time", 1e6),
                     .time_tolerance_s = 1e-6});
  drivers.push_back({.name = "VelodyneStampedAtEndNegative",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 18, FieldType::kFloat32)}),
                     .point_step = 22,
                     .store_time =
                         [](TestCloud& cloud, std::size_t i, const SeenPoint& point, Timestamp) {
                           const test::SpinningLidar lidar;
                           cloud.Set(i, "time", point.time_s - CloudSeconds(lidar));
                         },
                     .stamp_is_end = true,
                     .time_tolerance_s = 1e-8});
  drivers.push_back({.name = "VelodyneWithoutTime",
                     .fields = Fields({Field("intensity", 16, FieldType::kFloat32),
                                       Field("ring", 20, FieldType::kUint16)}),
                     .point_step = 32,
                     .store_time = NoTime});
  drivers.push_back({.name = "VelodyneWithZeroTimes",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 18, FieldType::kFloat32)}),
                     .point_step = 22,
                     .store_time = NoTime});
  drivers.push_back({.name = "RoboSenseBare",
                     .fields = Fields({kIntensity}),
                     .point_step = 16,
                     .store_time = NoTime,
                     .has_ring = false});
  drivers.push_back(
      {.name = "Ouster",
       .fields = Fields(
           {Field("intensity", 16, FieldType::kFloat32), Field("t", 20, FieldType::kUint32),
            Field("reflectivity", 24, FieldType::kUint16), Field("ring", 26, FieldType::kUint8),
            Field("ambient", 28, FieldType::kUint16), Field("range", 32, FieldType::kUint32)}),
       .point_step = 48,
       .store_time = InUnits("t", 1e9),
       .organised = true,
       .ring_from_top = true,
       .time_tolerance_s = 1e-9});
  drivers.push_back({.name = "OusterWithoutTime",
                     .fields = Fields({Field("intensity", 16, FieldType::kFloat32)}),
                     .point_step = 48,
                     .store_time = NoTime,
                     .organised = true,
                     .has_ring = false,
                     .time_tolerance_s = 4e-5});
  drivers.push_back({.name = "Hesai",
                     .fields = Fields({Field("intensity", 16, FieldType::kFloat32),
                                       Field("timestamp", 24, FieldType::kFloat64),
                                       Field("ring", 32, FieldType::kUint16)}),
                     .point_step = 48,
                     .store_time = Absolute("timestamp"),
                     .ring_from_top = true,
                     .time_tolerance_s = kAbsoluteTolerance});
  drivers.push_back({.name = "RoboSenseOrganised",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("timestamp", 18, FieldType::kFloat64)}),
                     .point_step = 26,
                     .store_time = Absolute("timestamp"),
                     .stamp_is_end = true,
                     .organised = true,
                     .time_tolerance_s = kAbsoluteTolerance});
  drivers.push_back({.name = "ShuffledWithTime",
                     .fields = Fields({kIntensity, Field("ring", 16, FieldType::kUint16),
                                       Field("time", 18, FieldType::kFloat32)}),
                     .point_step = 22,
                     .store_time = InUnits("time", 1.0),
                     .shuffled = true,
                     .time_tolerance_s = 1e-8});
  return drivers;
}

}  // namespace lio::test
