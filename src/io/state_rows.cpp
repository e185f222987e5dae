// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "state_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

// These blocks of FilterReport::cov are in the order that lio/pipeline/outputs.hpp names.
constexpr Eigen::Index kVelocityAt = 6;
constexpr Eigen::Index kGyroBiasAt = 9;
constexpr Eigen::Index kAccelBiasAt = 12;

void AddNames(const char* what, const char* unit, std::string& header) {
  for (const char* axis : {"x", "y", "z"}) header += fmt::format(",{}_{}_{}", what, axis, unit);
  for (const char* axis : {"x", "y", "z"}) header += fmt::format(",{}_{}_std_{}", what, axis, unit);
}

void AddValues(const Vector3& value, const FilterReport& filter, Eigen::Index at,
               std::string& row) {
  for (const double element : value) row += fmt::format(",{:.6e}", element);
  for (Eigen::Index i = at; i < at + 3; ++i) {
    const double variance = i < filter.cov.rows() ? filter.cov(i, i) : 0.0;
    row += fmt::format(",{:.6e}", std::sqrt(std::max(0.0, variance)));
  }
}

}  // namespace

std::string StateHeader() {
  std::string header = "t_s,segment,status,trust";
  AddNames("velocity", "mps", header);
  AddNames("gyro_bias", "radps", header);
  AddNames("accel_bias", "mps2", header);
  return header + ",clock_offset_s,clock_offset_std_s,nis,nis_dof\n";
}

std::string StateRow(int segment, const FilterReport& filter, Trust trust) {
  std::string row = fmt::format("{},{},{},{}", StampText(filter.nav.stamp), segment,
                                static_cast<int>(filter.nav.status), static_cast<int>(trust));
  AddValues(filter.nav.v_world_imu_mps, filter, kVelocityAt, row);
  AddValues(filter.gyro_bias_radps, filter, kGyroBiasAt, row);
  AddValues(filter.accel_bias_mps2, filter, kAccelBiasAt, row);
  return row + fmt::format(",{:.6e},{:.6e},{:.6e},{}\n", filter.clock_offset_s,
                           filter.clock_offset_std_s, filter.nis, filter.nis_dof);
}

}  // namespace lio
