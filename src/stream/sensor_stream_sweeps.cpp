// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The way of sweeps through the stream: from the assembler through the gate, and what happens where
// no inertial samples cover them.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lio/filter/sample_lookup.hpp"
#include "lio/stream/sensor_stream.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {

void SensorStream::CloseSweepsBefore(Timestamp stamp) {
  assembler_.CloseUpTo(stamp - Duration::FromSeconds(options_.incomplete_sweep_wait_s));
}

void SensorStream::TakeClosedSweeps() {
  while (std::optional<Sweep> sweep = assembler_.Take()) gate_.Add(std::move(*sweep));
}

void SensorStream::OpenGate() {
  TakeClosedSweeps();
  const std::optional<Timestamp> newest = imu_.newest();
  if (has_imu_ && !newest && gate_.waiting_span_s() > kStream.no_imu_after_s) {
    GoLidarOnly("no inertial samples come");
  }
  if (!has_imu_) {
    while (SweepPtr sweep = gate_.Force()) GiveOut(std::move(sweep));
    return;
  }
  const Duration correction = corrections_.ForNextSweeps();
  while (std::shared_ptr<Sweep> sweep = gate_.Open(newest, correction)) Admit(std::move(sweep));
  if (gate_.IsImuSilent() && life_ != Life::kClosed) state_ = State::kLosingImu;
  if (newest && !gate_.empty()) NotifyIfClocksApart(*newest, gate_.oldest().start);
}

void SensorStream::GoLidarOnly(const std::string& evidence) {
  has_imu_ = false;
  const Sweep& first = gate_.oldest();
  ImuAbsent absent{first.end, evidence, first.start};
  if (!imu_.samples().empty()) {
    absent.w_imu_radps = SampleAt(imu_.samples(), first.start).w_imu_radps;
  }
  events_.emplace_back(std::move(absent));
}

bool SensorStream::NotifyIfClocksApart(Timestamp imu, Timestamp lidar) {
  const double ahead_s = SecondsBetween(imu, lidar);
  if (std::abs(ahead_s) < kStream.clocks_apart_s) return false;
  const std::string text = fmt::format(
      "scans are stamped {:.1f} s {} the inertial samples and cannot be used: give both sensors "
      "one clock, or set rig.lidar.clock_offset_s",
      std::abs(ahead_s), ahead_s > 0.0 ? "after" : "before");
  events_.emplace_back(Notice{imu, Notice::Severity::kInfo, text});
  return true;
}

void SensorStream::Admit(std::shared_ptr<Sweep> sweep) {
  sweep->MoveBy(corrections_.ForNextSweeps());
  const Timestamp earliest = begin_ ? *begin_ : imu_.sent().front().stamp;
  if (sweep->start + kStream.stamp_slack < earliest) {
    ++counters_->num_scans_without_imu;
    counters_->ledgers.scans.Settle(ScanFate::kWithoutImu);
    NotifyIfClocksApart(earliest, sweep->start);
    return;
  }
  // From here on nothing may change what the scan is deskewed and predicted with.
  std::vector<ImuReady> ready;
  imu_.FreezeUpTo(sweep->end, ready);
  Emit(std::move(ready));
  GiveOut(std::move(sweep));
}

void SensorStream::GiveOut(SweepPtr sweep) {
  corrections_.CountSweep();
  events_.emplace_back(SweepReady{std::move(sweep)});
}

void SensorStream::CloseAll() {
  life_ = Life::kClosed;
  AcceptAll(preprocessor_.Flush());
  TakeChunks(lidar_clock_.Release());
  assembler_.CloseAll();
  OpenGate();
  gate_.Flush();
  if (has_imu_ && !imu_.newest() && !gate_.empty()) {
    GoLidarOnly("the log ended without inertial samples");
  }
  OpenGate();
  while (!gate_.empty()) {
    if (gate_.oldest().start > *imu_.newest()) ++counters_->num_scans_without_imu;
    Admit(gate_.Force());
  }
  events_.emplace_back(StreamEnded{});
}

}  // namespace lio
