// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks inertial samples up that ascend in time: by stamp or interpolated; and inserts in order.
#pragma once

#include <algorithm>
#include <deque>
#include <iterator>

#include "lio/filter/process_model.hpp"

namespace lio {

// Returns the first sample that is not before `stamp`, or the end.
template <class Samples>
auto FirstNotBefore(const Samples& samples, Timestamp stamp) {
  return std::lower_bound(std::begin(samples), std::end(samples), stamp,
                          [](const ImuSample& sample, Timestamp t) { return sample.stamp < t; });
}

// Returns the sample at `stamp`: linear between two samples, constant before the first and after
// the last. Needs at least one sample.
template <class Samples>
ImuSample SampleAt(const Samples& samples, Timestamp stamp) {
  const auto after = FirstNotBefore(samples, stamp);
  const auto before = after == std::begin(samples) ? after : std::prev(after);
  return InterpolateSample(*before, after == std::end(samples) ? *before : *after, stamp);
}

// Inserts a sample by its stamp; fast at the end. False: a sample of that stamp exists, nothing is
// inserted.
inline bool InsertByStamp(std::deque<ImuSample>& samples, const ImuSample& sample) {
  auto at = samples.end();
  while (at != samples.begin() && std::prev(at)->stamp > sample.stamp) --at;
  if (at != samples.begin() && std::prev(at)->stamp == sample.stamp) return false;
  samples.insert(at, sample);
  return true;
}

}  // namespace lio
