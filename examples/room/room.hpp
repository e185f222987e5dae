// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sensor data for the examples, computed: a cart stands in a box-shaped hall for two seconds and
// then speeds up along x. A real program has drivers in its place.
#pragma once

#include <cmath>
#include <lio/sensor/imu_sample.hpp>
#include <lio/sensor/lidar_sweep.hpp>

namespace room {

inline constexpr double kDuration_s = 6.0;
inline constexpr double kSweep_s = 0.1;
inline constexpr double kRest_s = 2.0;
inline constexpr double kAcceleration_mps2 = 0.5;
inline const lio::Vector3 kLidarInImu(0.1, 0.0, 0.3);  // [m]; the axes are parallel

inline lio::Timestamp StampAt(double t_s) {
  return lio::Timestamp{1'700'000'000'000'000'000} + lio::Duration::FromSeconds(t_s);
}

// The IMU has this x [m]; it begins in the origin.
inline double TrueX(double t_s) {
  const double moving_s = std::max(0.0, t_s - kRest_s);
  return 0.5 * kAcceleration_mps2 * moving_s * moving_s;
}

inline lio::ImuSample ImuAt(double t_s) {
  lio::ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.f_imu_mps2 = {t_s < kRest_s ? 0.0 : kAcceleration_mps2, 0.0, 9.80665};
  return sample;
}

// How far the walls, the floor or the ceiling are from a point in a direction [m].
inline double RangeFrom(const lio::Vector3& from, const lio::Vector3& direction) {
  const lio::Vector3 low(-15.0, -6.0, -1.5), high(18.0, 8.0, 5.0);
  double range = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double wall = direction[i] > 0.0 ? high[i] : low[i];
    if (std::abs(direction[i]) > 1e-9) range = std::min(range, (wall - from[i]) / direction[i]);
  }
  return range;
}

// One turn of a lidar of 16 beams that begins at `begin_s`.
inline lio::LidarSweep SweepAt(double begin_s) {
  lio::LidarSweep sweep{StampAt(begin_s), {}};
  for (int column = 0; column < 900; ++column) {
    const double offset_s = kSweep_s * column / 900.0;
    const double azimuth = 2.0 * M_PI * column / 900.0;
    const lio::Vector3 from = kLidarInImu + lio::Vector3(TrueX(begin_s + offset_s), 0.0, 0.0);
    for (int ring = 0; ring < 16; ++ring) {
      const double elevation = (-15.0 + 2.0 * ring) * M_PI / 180.0;
      const lio::Vector3 direction(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const lio::Vector3 point = RangeFrom(from, direction) * direction;
      sweep.points.push_back({.x_m = static_cast<float>(point.x()),
                              .y_m = static_cast<float>(point.y()),
                              .z_m = static_cast<float>(point.z()),
                              .t_offset_ns = static_cast<std::uint32_t>(offset_s * 1e9),
                              .ring = static_cast<std::uint16_t>(ring)});
    }
  }
  return sweep;
}

}  // namespace room
