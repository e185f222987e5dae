// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts a network capture (pcap, pcapng) of a lidar's packets to an LCM log, with the samples of
// the lidar's own IMU or of a file beside the capture.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/io/stream_stats.hpp"

namespace lio {

struct PcapOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<std::string> sensor;              // "192.168.1.201:2368", of several
  std::optional<std::filesystem::path> metadata;  // Ouster only; default: the capture's .json
  std::optional<std::filesystem::path> imu;       // default: ImuFileBeside
  bool whole_scans = false;
  std::function<void(double)> progress;  // called with the share done, 0..1; may be empty
};

struct PcapLosses {
  std::int64_t num_packets_lost = 0;     // on the way to the capturing host: no fault of the file
  std::int64_t num_packets_damaged = 0;  // whose content contradicts their format
  std::int64_t num_frames_cut = 0;       // captured with fewer bytes than were sent, or malformed
  std::int64_t num_fragments_lost = 0;   // parts of datagrams that never became whole
  std::int64_t num_imu_damaged = 0;      // samples that cannot be read
  std::string fault;                     // why the capture ends early; empty when it does not
};

struct PcapReport {
  std::string sensor;      // "192.168.1.201:2368"
  std::string model;       // vlp16, hdl32e, or ouster
  std::string clock_text;  // for the user: whose clock the stamps are of
  StreamStats lidar;
  StreamStats imu;
  AccelerometerStats accelerometer;
  std::string imu_text;             // names the source of the samples; empty without any
  std::optional<Pose> T_imu_lidar;  // as the sensor's description tells it, if it does
  std::int64_t num_points = 0;
  std::int64_t num_packets = 0;
  std::int64_t num_datagrams_other = 0;  // from other senders, to other ports or of other kinds
  std::int64_t num_frames_other = 0;     // no UDP over IPv4
  std::int64_t num_parts_of_turns = 0;   // left out, at the capture's ends and at gaps
  std::int64_t num_events = 0;
  std::int64_t num_late_events = 0;

  PcapLosses losses;

  // Returns true when something was lost, which means exit code 5.
  [[nodiscard]] bool IsDamaged() const {
    const std::int64_t num_damaged = losses.num_packets_damaged + losses.num_frames_cut +
                                     losses.num_fragments_lost + losses.num_imu_damaged;
    return num_damaged > 0 || !losses.fault.empty();
  }
};

// Returns a file of inertial samples beside drive.pcap: drive.imu.csv, .lcm, .bag, .db3 or .mcap.
[[nodiscard]] std::optional<std::filesystem::path> ImuFileBeside(
    const std::filesystem::path& capture);

// Returns the files that ConvertPcap reads, also those that it finds beside the capture.
[[nodiscard]] std::vector<std::filesystem::path> InputsOf(const PcapOptions& options);

// Throws UsageError for several lidars of which none was chosen, InputError for a capture without
// one, and std::runtime_error when the output cannot be written.
[[nodiscard]] PcapReport ConvertPcap(const PcapOptions& options);

[[nodiscard]] std::string FormatReport(const PcapReport& report, const PcapOptions& options);

}  // namespace lio
