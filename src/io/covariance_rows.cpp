// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "covariance_rows.hpp"

#include <fmt/format.h>

#include <array>

#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

constexpr std::array<const char*, 6> kPoseErrorNames = {"x", "y", "z", "rx", "ry", "rz"};

}  // namespace

std::string CovarianceHeader() {
  std::string header = "t_s";
  for (const char* row : kPoseErrorNames) {
    for (const char* column : kPoseErrorNames) header += fmt::format(",cov_{}_{}", row, column);
  }
  return header + "\n";
}

std::string CovarianceRow(Timestamp stamp, const Matrix6& cov) {
  std::string text = StampText(stamp);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      text += fmt::format(",{:.12e}", cov(row, column));
    }
  }
  return text + "\n";
}

}  // namespace lio
