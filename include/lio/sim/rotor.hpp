// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the head of a lidar, or its prisms: which way it points at an instant, which way its
// encoder says it points, and which columns of firings belong to a turn. Times are of the
// trajectory.
#pragma once

#include <array>
#include <cstdint>

#include "lio/base/pose.hpp"
#include "lio/sim/lidar_model.hpp"

namespace lio::sim {

struct RotorErrors {
  // The speed varies by this, 1 sigma. KITTI's HDL-64E: its sweeps of 103.3 ms vary by 0.1 ms.
  double speed_std_ratio = 0.0;
  // The encoder errs by this once a turn, 1 sigma. The data sheet of the OS1 states an angular
  // accuracy of +-0.01 deg, which is taken for the amplitude.
  double encoder_std_rad = 0.0;
};

// Holds the columns of one turn, counted from the log's first one.
struct TurnColumns {
  std::int64_t first = 0;
  std::int64_t num = 0;
  double begin_s = 0.0;
  double end_s = 0.0;
};

class Rotor {
 public:
  // Turn 0 begins at `begin_s`.
  Rotor(const LidarModel& model, const RotorErrors& errors, std::uint64_t seed, double begin_s);

  [[nodiscard]] double ColumnTime(std::int64_t column) const;
  [[nodiscard]] double HeadingAt(double t_s) const;  // clockwise from the cut
  [[nodiscard]] double ReportedHeadingAt(double t_s) const;
  // Returns R_lidar_column, which turns a beam's direction at heading 0 to where it points, true
  // and as the sensor reports it.
  [[nodiscard]] Matrix3 OrientationAt(double t_s) const;
  [[nodiscard]] Matrix3 ReportedOrientationAt(double t_s) const;
  [[nodiscard]] TurnColumns ColumnsOf(std::int64_t turn) const;

 private:
  struct Wave {
    double amplitude_turns = 0.0;
    double frequency_hz = 1.0;
    double phase_rad = 0.0;
  };
  [[nodiscard]] double TurnsAt(double t_s) const;
  [[nodiscard]] std::int64_t FirstColumnOf(std::int64_t turn) const;

  double rotation_hz_;
  double column_period_s_;
  double cut_azimuth_rad_;
  double begin_s_;
  double view_azimuth_rad_;
  std::optional<Rosette> rosette_;
  bool wobbles_;
  std::array<Wave, 2> waves_;
  double encoder_rad_ = 0.0;
  double encoder_phase_rad_ = 0.0;
};

}  // namespace lio::sim
