// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where an instant lies among inertial samples that are in order of time, and what they read there.
#pragma once

#include <algorithm>
#include <iterator>

#include "lio/filter/process_model.hpp"

namespace lio {

// The first sample that is not before `stamp`, or the end.
template <class Samples>
auto FirstNotBefore(const Samples& samples, Timestamp stamp) {
  return std::lower_bound(std::begin(samples), std::end(samples), stamp,
                          [](const ImuSample& sample, Timestamp t) { return sample.stamp < t; });
}

// Between two samples linear, outside of all the nearest one's reading. Needs at least one.
template <class Samples>
ImuSample SampleAt(const Samples& samples, Timestamp stamp) {
  const auto after = FirstNotBefore(samples, stamp);
  if (after == std::end(samples))
    return InterpolateSample(*std::prev(after), *std::prev(after), stamp);
  if (after == std::begin(samples)) return InterpolateSample(*after, *after, stamp);
  return InterpolateSample(*std::prev(after), *after, stamp);
}

}  // namespace lio
