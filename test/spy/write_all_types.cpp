// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a log with one message of each of liod's types, for the test of the Java classes.
#include "lio/io/event_log.hpp"
#include "lio/io/lcm_codec.hpp"
#include "lio/io/status_report.hpp"

int main(int argc, char** argv) {
  using namespace lio;
  if (argc != 2) return 2;
  const Channels channels;
  FilterReport filter;
  filter.cov = Eigen::MatrixXd::Identity(21, 21);
  ScanReport scan;
  scan.information_eigenvalues << 1, 2, 3, 4, 5, 6;
  StatusReport status;
  status.note = "waiting for rest";
  const RegisteredCloud cloud{Timestamp{5000}, 3, std::vector<Eigen::Vector3f>(7)};
  EventLogWriter writer(argv[1]);
  writer.Write(1, channels.imu, EncodeImu({.stamp = Timestamp{5000}}, 1));
  writer.Write(2, channels.scan,
               EncodeChunk({Timestamp{5000}, 1, 0, 1, 0, std::vector<LidarPoint>(9)}));
  writer.Write(3, channels.odometry, EncodeOdometry(filter.nav));
  writer.Write(4, channels.state, EncodeFilterState(filter));
  writer.Write(5, channels.registration, EncodeRegistration(scan));
  writer.Write(6, channels.cloud, EncodeCloud(cloud));
  writer.Write(7, channels.status, EncodeStatus(status, "1.2.3"));
  writer.Write(8, channels.command, EncodeCommand({.request_id = 1}));
  writer.Write(9, channels.reply, EncodeReply({.request_id = 1, .is_done = true, .text = "done"}));
  writer.Close();
  return 0;
}
