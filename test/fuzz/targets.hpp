// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Everything that takes bytes from outside, as functions that a fuzzer can call: libFuzzer's
// (tools/fuzz.sh), and the test that runs the inputs of test/fuzz/corpus/.
//
// A target returns for any bytes. It aborts where a promise is broken, and lets through no
// exception.
#pragma once

#include <array>
#include <string_view>

#include "lio/io/lcm_codec.hpp"

namespace lio::fuzz {

void Messages(ByteView bytes);         // LCM: samples, chunks, commands and their names, outputs
void EventLog(ByteView bytes);         // an LCM log
void Rosbag1(ByteView bytes);          // a ROS 1 bag and its messages
void Rosbag2(ByteView bytes);          // a ROS 2 bag: SQLite with CDR
void Rosbag2Metadata(ByteView bytes);  // its metadata.yaml
void Mcap(ByteView bytes);             // an MCAP file
void RosMessages(ByteView bytes);      // messages of ROS 1 and 2, Livox's too, and definitions
void Pcap(ByteView bytes);             // a capture of packets, with Ouster's metadata
void LidarPackets(ByteView bytes);     // packets of Velodyne and Ouster
void OusterJson(ByteView bytes);       // Ouster's metadata
void ImuTable(ByteView bytes);         // samples beside a capture
void Kitti(ByteView bytes);            // scans, stamps, calibrations, OXTS
void Map(ByteView bytes);              // PCD and PLY
void Trajectory(ByteView bytes);       // TUM and KITTI poses
void Table(ByteView bytes);            // CSV of a run
void RunFolder(ByteView bytes);        // all files of a run that lio-eval and the report read
void Config(ByteView bytes);           // configuration, rigs included
void SensorFile(ByteView bytes);       // config/lidars and config/imus
void HttpRequests(ByteView bytes);     // requests to lio-view
void ClientMessages(ByteView bytes);   // messages of its page

struct Target {
  std::string_view name;  // the folder of its inputs
  void (*run)(ByteView bytes);
};
inline constexpr std::array kTargets = std::to_array<Target>({{"messages", Messages},
                                                              {"event_log", EventLog},
                                                              {"rosbag1", Rosbag1},
                                                              {"rosbag2", Rosbag2},
                                                              {"rosbag2_metadata", Rosbag2Metadata},
                                                              {"mcap", Mcap},
                                                              {"ros_messages", RosMessages},
                                                              {"pcap", Pcap},
                                                              {"lidar_packets", LidarPackets},
                                                              {"ouster_json", OusterJson},
                                                              {"imu_table", ImuTable},
                                                              {"kitti", Kitti},
                                                              {"map", Map},
                                                              {"trajectory", Trajectory},
                                                              {"table", Table},
                                                              {"run_folder", RunFolder},
                                                              {"config", Config},
                                                              {"sensor_file", SensorFile},
                                                              {"http_requests", HttpRequests},
                                                              {"client_messages", ClientMessages}});

}  // namespace lio::fuzz
