// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/estimate.hpp"

namespace lio::python {
namespace {

constexpr Eigen::Index kVelocityAt = 6;  // in FilterReport::cov, behind position and rotation

}  // namespace

std::optional<Estimate> EstimateOf(const Output& output) {
  if (const auto* nav = std::get_if<NavOutput>(&output)) return EstimateOf({}, *nav);
  const auto* scan = std::get_if<ScanOutput>(&output);
  if (scan == nullptr || !scan->filter) return std::nullopt;
  Estimate estimate;
  estimate.report = *scan->filter;
  estimate.match = scan->scan;
  return estimate;
}

Estimate EstimateOf(const std::string& channel, const NavOutput& nav) {
  Estimate estimate;
  estimate.channel = channel;
  estimate.report.nav = nav;
  estimate.has_filter = false;
  return estimate;
}

Estimate EstimateOfState(const std::string& channel, const FilterReport& report) {
  Estimate estimate;
  estimate.channel = channel;
  estimate.report = report;
  estimate.has_status = false;
  estimate.has_map = false;
  NavOutput& nav = estimate.report.nav;
  if (report.cov.rows() >= kVelocityAt + 3) {
    nav.pose_cov = report.cov.topLeftCorner<6, 6>();
    nav.velocity_cov = report.cov.block<3, 3>(kVelocityAt, kVelocityAt);
  }
  return estimate;
}

}  // namespace lio::python
