// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds an estimate as Python sees it: of the estimator here, or of a message in a log.
#pragma once

#include <optional>
#include <string>

#include "lio/pipeline/odometry.hpp"

namespace lio::python {

struct Estimate {
  std::string channel;  // the log's; empty where the estimator is here
  // Members that the estimate does not have keep their defaults; the marks below say so.
  FilterReport report;
  std::optional<ScanReport> match;
  bool has_status = true;  // false for a message of LIO_STATE
  bool has_map = true;     // false for a message of LIO_STATE
  bool has_filter = true;  // biases and the like; only with a scan
};

// The estimator's outputs; a notice has none.
[[nodiscard]] std::optional<Estimate> EstimateOf(const Output& output);

// The messages of a log.
[[nodiscard]] Estimate EstimateOf(const std::string& channel, const NavOutput& nav);
[[nodiscard]] Estimate EstimateOfState(const std::string& channel, const FilterReport& report);

}  // namespace lio::python
