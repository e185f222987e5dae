// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/low_mean.hpp"

#include "lio/map/map_parameters.hpp"

namespace lio {

void LowMean::Add(double value, double low_below, double enough_above) {
  mean_ = mean_ ? *mean_ + LowMeanParameters::kRate * (value - *mean_) : value;
  if (*mean_ < low_below) is_low_ = true;
  if (*mean_ > enough_above) is_low_ = false;
}

}  // namespace lio
