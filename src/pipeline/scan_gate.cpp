// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/scan_gate.hpp"

#include <utility>

namespace lio {
namespace {

constexpr double kImuSilence_s = 1.0;  // the lidar goes on without the IMU after this
constexpr Duration kScanGap{250'000'000};
constexpr int kMaxLateInARow = 5;  // then the lidar's clock has moved back for good

}  // namespace

void ScanGate::Add(Sweep sweep) {
  ++counters_->num_scans;
  if (sweep.points.empty()) {
    ++counters_->num_scans_empty;
    return;
  }
  if (last_end_ && sweep.end <= *last_end_) {
    ++counters_->num_scans_late;
    if (++num_late_in_a_row_ < kMaxLateInARow) return;
    ++counters_->num_clock_jumps;
    waiting_.clear();
  } else if (last_end_ && sweep.start - *last_end_ > kScanGap) {
    ++counters_->num_scan_gaps;
  }
  num_late_in_a_row_ = 0;
  last_end_ = sweep.end;
  waiting_.push_back(std::make_shared<const Sweep>(std::move(sweep)));
}

double ScanGate::waiting_span_s() const {
  return waiting_.empty() ? 0.0 : SecondsBetween(waiting_.front()->end, waiting_.back()->end);
}

SweepPtr ScanGate::Open(std::optional<Timestamp> newest_imu) {
  if (waiting_.empty() || !newest_imu) return nullptr;
  if (*newest_imu >= waiting_.front()->end) return Force();
  if (waiting_span_s() <= kImuSilence_s) return nullptr;
  ++counters_->num_scans_without_imu;
  return Force();
}

SweepPtr ScanGate::Force() {
  if (waiting_.empty()) return nullptr;
  SweepPtr sweep = std::move(waiting_.front());
  waiting_.pop_front();
  return sweep;
}

}  // namespace lio
