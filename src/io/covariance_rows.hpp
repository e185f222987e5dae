// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the rows of covariance*.csv: t_s and the 6x6 covariance of [position; right rotation],
// row-major.
#pragma once

#include <string>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

[[nodiscard]] std::string CovarianceHeader();
[[nodiscard]] std::string CovarianceRow(Timestamp stamp, const Matrix6& cov);

}  // namespace lio
