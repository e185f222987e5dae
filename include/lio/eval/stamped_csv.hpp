// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads tables as a run writes them: one header line, comma separated, the first column `t_s`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

struct StampedTable {
  std::vector<std::string> columns;  // names of the columns of `rows`, without t_s
  std::vector<Timestamp> stamps;
  std::vector<std::vector<double>> rows;
};

// Returns the named columns in that order, or all columns when no names are given. Throws
// std::runtime_error "FILE:LINE: message" when the file cannot be read, lacks a column, or holds no
// finite number where one is wanted. A last row that is cut is left out, as in ReadTrajectory.
[[nodiscard]] StampedTable ReadStampedCsv(const std::filesystem::path& file,
                                          const std::vector<std::string>& wanted = {});

}  // namespace lio
