// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes the wanted points of a sweep without thinning, for the warm-up of a map. Lidar frame,
// metres, each point at its own instant; ordered by time, so that the order of the input does not
// matter.
#pragma once

#include <vector>

#include "lio/scan/point_filter.hpp"
#include "lio/scan/reduced_scan.hpp"

namespace lio {

// The points are a sample of about ThinningParameters::max_sampled. It costs about 4 ms. Throws
// nothing.
std::vector<ScanPoint> DensePoints(const Sweep& sweep, const PointFilter& filter);

}  // namespace lio
