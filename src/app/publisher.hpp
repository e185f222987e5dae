// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Publishes the daemon's outputs on the bus. Any thread may publish.
#pragma once

#include <atomic>
#include <cstdint>

#include "lio/io/bus.hpp"
#include "lio/io/command.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/status_report.hpp"
#include "lio/pipeline/odometry.hpp"

namespace lio {

class Publisher {
 public:
  // Both are borrowed for as long as this lives.
  Publisher(Bus& bus, const Channels& channels) : bus_(bus), channels_(channels) {}

  // Publishes odometry, filter state and registration of a scan, or odometry of an inertial sample.
  // Notices are not published here: the status has them.
  void Publish(const Output& output);
  void Publish(const StatusReport& status, const std::string& version);
  void Publish(const Reply& reply);
  // The cloud has at most kMaxCloudPoints points.
  void Publish(const RegisteredCloud& cloud);
  // Publishes a chunk of LIO_CLOUD_FULL, which is in the frame `map` already.
  void PublishFull(const ScanChunk& chunk);
  // Publishes a chunk of one of LOAM's feature sets.
  void PublishFeatures(FeatureSet set, const ScanChunk& chunk);

  // A cloud takes 60 kB at most: one datagram, and no more than Java's lcm-spy can take.
  static constexpr std::size_t kMaxCloudPoints = 3000;

  // How many messages the transport has refused.
  [[nodiscard]] std::int64_t num_failed() const { return num_failed_; }

 private:
  void Send(const NavOutput& nav);
  void Send(const std::string& channel, const Bytes& bytes);

  Bus& bus_;
  const Channels& channels_;
  std::atomic<std::int64_t> num_failed_ = 0;
};

}  // namespace lio
