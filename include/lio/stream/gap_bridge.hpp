// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the samples that stand in for those of a gap, as far as the ones before it tell. The force
// is their mean, since a walker's last sample is a push. The rate goes from the last one to their
// mean as fast as the rates before forgot what they had been: a turning head turns on, a walker's
// sway has passed within a sweep. This is the best linear prediction of a first-order Gauss-Markov
// process (A. Gelb (ed.), "Applied Optimal Estimation", 1974, section 3.6).
#pragma once

#include <deque>

#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

class GapBridge {
 public:
  // `sent` holds the samples up to the gap, not empty, the last one measured; they are read under
  // `convention`.
  GapBridge(const std::deque<ImuSample>& sent, const ImuConvention& convention);

  // Returns the sample for an instant of the gap, as it would be sent. It states how far, per axis,
  // the motion may be from it: as far as that of the last seconds was from the mean.
  [[nodiscard]] ImuSample At(Timestamp stamp) const;
  // Returns the sample for the beginning of a part of the gap, from which a line to At(to) turns by
  // as much as the fading rate does: two samples then stand for all of it.
  [[nodiscard]] ImuSample BeginLine(Timestamp from, Timestamp to) const;

 private:
  // Returns the share of the last rate's deviation from the mean that is left.
  [[nodiscard]] double KeptAt(Timestamp stamp) const;

  ImuSample last_;
  ImuSample mean_;
  double correlation_time_s_;  // correlation time of the rates
};

}  // namespace lio
