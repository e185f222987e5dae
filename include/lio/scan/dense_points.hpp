// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// All that a sweep shows, for a map that has seen little yet: the points that the thinning chooses
// from, by time, whatever order they come in.
#pragma once

#include <vector>

#include "lio/scan/point_filter.hpp"
#include "lio/scan/reduced_scan.hpp"

namespace lio {

// At most about 32 000 points. Cost: about 4 ms.
std::vector<ScanPoint> DensePoints(const Sweep& sweep, const PointFilter& filter);

}  // namespace lio
