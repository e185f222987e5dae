// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tables as a run writes them: one header line, comma separated, the first column `t_s`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

struct StampedTable {
  std::vector<std::string> columns;  // of `rows`, without t_s
  std::vector<Timestamp> stamps;
  std::vector<std::vector<double>> rows;
};

// The named columns, in that order; with no names all of them. Throws std::runtime_error
// "FILE:LINE: message" when the file cannot be read, lacks a column, or holds no finite number
// where a wanted one should be.
StampedTable ReadStampedCsv(const std::filesystem::path& file,
                            const std::vector<std::string>& wanted = {});

}  // namespace lio
