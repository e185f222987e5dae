// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The daemon's outputs onto the bus. Any thread may publish.
#pragma once

#include <atomic>
#include <cstdint>

#include "lio/io/bus.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/status_report.hpp"
#include "lio/pipeline/odometry.hpp"

namespace lio {

class Publisher {
 public:
  // Both are borrowed for as long as this lives.
  Publisher(Bus& bus, const Channels& channels) : bus_(bus), channels_(channels) {}

  // Odometry, filter state and registration of a scan, odometry of an inertial sample.
  void Publish(const Output& output);
  void Publish(const StatusReport& status, const std::string& version);
  // At most kMaxCloudPoints points.
  void Publish(const RegisteredCloud& cloud);
  // A part of LIO_CLOUD_FULL, registered already.
  void PublishFull(const ScanChunk& chunk);

  // A part of one of LOAM's sets.
  void PublishFeatures(FeatureSet set, const ScanChunk& chunk);

  static constexpr std::size_t kMaxCloudPoints =
      3000;  // 60 kB: one datagram, and Java's lcm-spy lives

  std::int64_t num_failed() const { return num_failed_; }

 private:
  void Send(const NavOutput& nav);
  void Send(const std::string& channel, const Bytes& bytes);

  Bus& bus_;
  const Channels& channels_;
  std::atomic<std::int64_t> num_failed_ = 0;
};

}  // namespace lio
