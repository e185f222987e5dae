// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/publisher.hpp"

namespace lio {

void Publisher::Send(const std::string& channel, const Bytes& bytes) {
  if (!bus_.Publish(channel, bytes)) ++num_failed_;
}

void Publisher::Send(const NavOutput& nav) {
  const bool is_imu_rate = nav.source == OdometrySource::kImuPropagated;
  Send(is_imu_rate ? channels_.odometry_imu_rate : channels_.odometry, EncodeOdometry(nav));
  if (!nav.base) return;
  Send(is_imu_rate ? channels_.odometry_base_imu_rate : channels_.odometry_base,
       EncodeBaseOdometry(nav));
}

void Publisher::Publish(const Output& output) {
  if (const auto* nav = std::get_if<NavOutput>(&output)) {
    Send(*nav);
  } else if (const auto* scan = std::get_if<ScanOutput>(&output)) {
    if (scan->filter) {
      Send(scan->filter->nav);
      Send(channels_.odometry_local, EncodeLocalOdometry(*scan->filter));
      Send(channels_.state, EncodeFilterState(*scan->filter));
    }
    Send(channels_.registration, EncodeRegistration(scan->scan));
  }
}

void Publisher::Publish(const StatusReport& status, const std::string& version) {
  Send(channels_.status, EncodeStatus(status, version));
}

void Publisher::Publish(const Reply& reply) {
  Send(channels_.reply, EncodeReply(reply));
}

void Publisher::Publish(const RegisteredCloud& cloud) {
  Send(channels_.cloud, EncodeCloud(cloud));
}

void Publisher::PublishFull(const ScanChunk& chunk) {
  Send(channels_.cloud_full, EncodeChunk(chunk));
}

void Publisher::PublishFeatures(FeatureSet set, const ScanChunk& chunk) {
  Send(channels_.features[static_cast<std::size_t>(set)], EncodeChunk(chunk));
}

}  // namespace lio
