// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/oxts.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lio {

std::optional<OxtsRow> ParseOxts(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> n;
  double number = 0.0;
  while (words >> number) n.push_back(number);
  constexpr std::size_t kNumUsed = 25;  // up to the velocity accuracy; later ones are status
  const bool finite = std::all_of(n.begin(), n.end(), [](double v) { return std::isfinite(v); });
  if (n.size() < kNumUsed || !finite) return {};
  OxtsRow row;
  row.roll_rad = n[3];
  row.pitch_rad = n[4];
  row.yaw_rad = n[5];
  row.v_enu_mps = Vector3(n[7], n[6], n[10]);
  row.f_imu_mps2 = Vector3(n[11], n[12], n[13]);
  row.w_imu_radps = Vector3(n[17], n[18], n[19]);
  return row;
}

StampedPoses OxtsPoses(const std::vector<OxtsRow>& rows) {
  using Eigen::AngleAxisd;
  StampedPoses poses;
  Vector3 position = Vector3::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) {
      const double dt = SecondsBetween(rows[i - 1].stamp, rows[i].stamp);
      position += 0.5 * dt * (rows[i - 1].v_enu_mps + rows[i].v_enu_mps);
    }
    const Quaternion rotation(AngleAxisd(rows[i].yaw_rad, Vector3::UnitZ()) *
                              AngleAxisd(rows[i].pitch_rad, Vector3::UnitY()) *
                              AngleAxisd(rows[i].roll_rad, Vector3::UnitX()));
    poses.push_back({rows[i].stamp, {rotation, position}});
  }
  return poses;
}

std::vector<ImuSample> OxtsImu(const std::vector<OxtsRow>& rows, std::optional<double> rate_hz) {
  std::vector<ImuSample> samples;
  if (!rate_hz) {
    for (const OxtsRow& row : rows) samples.push_back({row.stamp, row.w_imu_radps, row.f_imu_mps2});
    return samples;
  }
  std::size_t after = 1;
  for (std::int64_t k = 0;; ++k) {
    const Timestamp stamp =
        rows.front().stamp + Duration::FromSeconds(static_cast<double>(k) / *rate_hz);
    if (stamp > rows.back().stamp) break;
    while (after + 1 < rows.size() && rows[after].stamp < stamp) ++after;
    if (after >= rows.size()) break;
    const OxtsRow& a = rows[after - 1];
    const OxtsRow& b = rows[after];
    const double share = SecondsBetween(a.stamp, stamp) / SecondsBetween(a.stamp, b.stamp);
    samples.push_back({stamp, a.w_imu_radps + share * (b.w_imu_radps - a.w_imu_radps),
                       a.f_imu_mps2 + share * (b.f_imu_mps2 - a.f_imu_mps2)});
  }
  if (samples.empty()) {  // there was only one row
    samples.push_back({rows.front().stamp, rows.front().w_imu_radps, rows.front().f_imu_mps2});
  }
  return samples;
}

}  // namespace lio
