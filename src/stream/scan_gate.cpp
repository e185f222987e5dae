// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/scan_gate.hpp"

#include <utility>

#include "lio/sensor/gap.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {
namespace {

bool HasTooMany(const std::deque<std::shared_ptr<Sweep>>& waiting) {
  if (waiting.size() < 2) return false;
  std::size_t num_points = 0;
  for (const std::shared_ptr<Sweep>& sweep : waiting) num_points += sweep->points.size();
  return waiting.size() > kScanGate.max_sweeps || num_points > kScanGate.max_points;
}

}  // namespace

void ScanGate::Add(Sweep sweep) {
  ++counters_->num_scans;
  if (sweep.points.empty()) {
    ++counters_->num_scans_empty;
    counters_->ledgers.scans.Settle(ScanFate::kEmpty);
    return;
  }
  if (Quarantine(sweep)) return;
  if (last_end_ && sweep.end <= *last_end_ && DropLate()) return;
  Accept(std::move(sweep));
}

void ScanGate::Accept(Sweep sweep) {
  if (last_end_ && sweep.start - *last_end_ > kScanGap.missing) {
    ++counters_->num_scan_gaps;
    // Stamps that step ahead of the inertial stream do not make that silent.
    if (imu_silent_at_) imu_silent_at_ = *imu_silent_at_ + (sweep.start - *last_end_);
  }
  num_late_in_a_row_ = 0;
  last_end_ = sweep.end;
  waiting_.push_back(std::make_shared<Sweep>(std::move(sweep)));
  while (waiting_span_s() > kScanGate.max_wait_s || HasTooMany(waiting_)) {
    waiting_.pop_front();
    ++counters_->num_scans_without_imu;
    counters_->ledgers.scans.Settle(ScanFate::kWithoutImu);
  }
}

// Counts a late sweep. False: so many come late that time itself has moved back.
bool ScanGate::DropLate() {
  ++counters_->num_scans_late;
  if (++num_late_in_a_row_ < kScanGate.max_late_in_a_row) {
    counters_->ledgers.scans.Settle(ScanFate::kLate);
    return true;
  }
  ++counters_->num_clock_jumps;
  DropWaiting();
  return false;
}

// Takes the sweep when it is far ahead; lets one in that was held before when this one follows it.
bool ScanGate::Quarantine(Sweep& sweep) {
  if (suspect_) {
    const Duration after = sweep.start - suspect_->end;
    if (sweep.end > suspect_->end && Abs(after) < kScanGate.bears_out) {
      Accept(std::move(*suspect_));
    } else {
      ++counters_->num_scans_late;
      counters_->ledgers.scans.Settle(ScanFate::kLate);
    }
    suspect_.reset();
  }
  if (!last_end_ || sweep.start - *last_end_ <= kScanGate.far_ahead) return false;
  suspect_ = std::move(sweep);
  return true;
}

void ScanGate::Flush() {
  if (suspect_) Accept(std::move(*suspect_));
  suspect_.reset();
}

void ScanGate::StartSegment(Timestamp first) {
  if (last_end_ && *last_end_ > first) DropWaiting();
}

void ScanGate::DropWaiting() {
  counters_->num_scans_without_imu += static_cast<std::int64_t>(waiting_.size());
  counters_->ledgers.scans.Settle(ScanFate::kWithoutImu, waiting_.size());
  waiting_.clear();
  last_end_.reset();
}

double ScanGate::waiting_span_s() const {
  return waiting_.empty() ? 0.0 : SecondsBetween(waiting_.front()->end, waiting_.back()->end);
}

std::shared_ptr<Sweep> ScanGate::Open(std::optional<Timestamp> newest_imu, Duration correction) {
  if (newest_imu != last_imu_) {
    last_imu_ = newest_imu;
    imu_silent_at_ = last_end_;
  }
  if (waiting_.empty() || !newest_imu) return nullptr;
  if (*newest_imu >= waiting_.front()->end + correction) return Force();
  if (!imu_silent_at_) imu_silent_at_ = waiting_.front()->start;
  return nullptr;
}

bool ScanGate::IsImuSilent() const {
  return imu_silent_at_ && !waiting_.empty() &&
         waiting_.back()->end - *imu_silent_at_ > kImuGap.segment;
}

std::shared_ptr<Sweep> ScanGate::Force() {
  if (waiting_.empty()) return nullptr;
  std::shared_ptr<Sweep> sweep = std::move(waiting_.front());
  waiting_.pop_front();
  return sweep;
}

}  // namespace lio
