// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/scan_gate.hpp"

#include <utility>

namespace lio {
namespace {

constexpr Duration kImuSilence{1'000'000'000};  // the lidar goes on without the IMU after this
constexpr Duration kScanGap{250'000'000};
constexpr double kMaxWait_s = 5.0;            // for inertial samples that come late
constexpr Duration kFarAhead{2'000'000'000};  // a longer gap may be a wrong stamp
constexpr Duration kBearsOut{500'000'000};    // of a wrong stamp no second one comes so near
constexpr int kMaxLateInARow = 5;             // then the lidar's clock has moved back for good

}  // namespace

void ScanGate::Add(Sweep sweep) {
  ++counters_->num_scans;
  if (sweep.points.empty()) {
    ++counters_->num_scans_empty;
    return;
  }
  if (HoldsBack(sweep)) return;
  if (last_end_ && sweep.end <= *last_end_ && DropLate()) return;
  LetIn(std::move(sweep));
}

void ScanGate::LetIn(Sweep sweep) {
  if (last_end_ && sweep.start - *last_end_ > kScanGap) {
    ++counters_->num_scan_gaps;
    // Stamps that step ahead of the inertial stream do not make that silent.
    if (imu_silent_at_) imu_silent_at_ = *imu_silent_at_ + (sweep.start - *last_end_);
  }
  num_late_in_a_row_ = 0;
  last_end_ = sweep.end;
  waiting_.push_back(std::make_shared<const Sweep>(std::move(sweep)));
  while (waiting_span_s() > kMaxWait_s) {
    waiting_.pop_front();
    ++counters_->num_scans_without_imu;
  }
}

// Counts a late sweep. False: so many come late that time itself has moved back.
bool ScanGate::DropLate() {
  ++counters_->num_scans_late;
  if (++num_late_in_a_row_ < kMaxLateInARow) return true;
  ++counters_->num_clock_jumps;
  counters_->num_scans_without_imu += static_cast<std::int64_t>(waiting_.size());
  waiting_.clear();
  last_end_.reset();
  return false;
}

// Takes the sweep when it is far ahead; lets one in that was held before when this one follows it.
bool ScanGate::HoldsBack(Sweep& sweep) {
  if (suspect_) {
    const Duration after = sweep.start - suspect_->end;
    if (sweep.end > suspect_->end && Abs(after) < kBearsOut) {
      LetIn(std::move(*suspect_));
    } else {
      ++counters_->num_scans_late;
    }
    suspect_.reset();
  }
  if (!last_end_ || sweep.start - *last_end_ <= kFarAhead) return false;
  suspect_ = std::move(sweep);
  return true;
}

void ScanGate::Flush() {
  if (suspect_) LetIn(std::move(*suspect_));
  suspect_.reset();
}

void ScanGate::BeginNewStretch(Timestamp first) {
  if (!last_end_ || *last_end_ <= first) return;
  counters_->num_scans_without_imu += static_cast<std::int64_t>(waiting_.size());
  waiting_.clear();
  last_end_.reset();
}

double ScanGate::waiting_span_s() const {
  return waiting_.empty() ? 0.0 : SecondsBetween(waiting_.front()->end, waiting_.back()->end);
}

SweepPtr ScanGate::Open(std::optional<Timestamp> newest_imu) {
  if (newest_imu != last_imu_) {
    last_imu_ = newest_imu;
    imu_silent_at_ = last_end_;
  }
  if (waiting_.empty() || !newest_imu) return nullptr;
  if (*newest_imu >= waiting_.front()->end) return Force();
  if (!imu_silent_at_) imu_silent_at_ = waiting_.front()->start;
  if (waiting_.back()->end - *imu_silent_at_ <= kImuSilence) return nullptr;
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
