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

void Messages(ByteView bytes);     // LCM: samples, chunks, commands, status
void EventLog(ByteView bytes);     // an LCM log
void Rosbag1(ByteView bytes);      // a ROS 1 bag and its messages
void Rosbag2(ByteView bytes);      // a ROS 2 bag: SQLite with CDR
void Mcap(ByteView bytes);         // an MCAP file
void RosMessages(ByteView bytes);  // messages of ROS 1 and 2, and their definitions
void Kitti(ByteView bytes);        // scans, stamps, calibrations, OXTS
void Map(ByteView bytes);          // PCD and PLY
void Trajectory(ByteView bytes);   // TUM and KITTI poses
void Config(ByteView bytes);       // configuration

struct Target {
  std::string_view name;  // the folder of its inputs
  void (*run)(ByteView bytes);
};
inline constexpr std::array kTargets = std::to_array<Target>({{"messages", Messages},
                                                              {"event_log", EventLog},
                                                              {"rosbag1", Rosbag1},
                                                              {"rosbag2", Rosbag2},
                                                              {"mcap", Mcap},
                                                              {"ros_messages", RosMessages},
                                                              {"kitti", Kitti},
                                                              {"map", Map},
                                                              {"trajectory", Trajectory},
                                                              {"config", Config}});

}  // namespace lio::fuzz
