// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "app/command_rules.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "lio/io/command.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/initial_map_file.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_account.hpp"
#include "lio/io/output_decoder.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio::fuzz {
namespace {

// A command that is obeyed has a pose of rotation and covariance, and names a file of one folder.
void JudgeCommand(const Command& command) {
  if (!WhyUnusable(command).empty()) return;
  const GivenPose pose = PoseOf(command);
  if (command.action == CommandAction::kResetAtPose && !pose.cov.allFinite()) std::abort();
  const std::filesystem::path file = command.name;
  if (command.action == CommandAction::kSaveMap && file.filename() != file) std::abort();
}

}  // namespace

void Messages(ByteView bytes) {
  ImuSample sample;
  std::int32_t seq = 0;
  (void)DecodeImu(bytes, sample, seq);
  ScanChunk chunk;
  if (DecodeChunk(bytes, chunk) == DecodeStatus::kOk && EncodeChunk(chunk).size() != bytes.size()) {
    std::abort();
  }
  Command command;
  if (DecodeCommand(bytes, command) == DecodeStatus::kOk) JudgeCommand(command);
  OutputAccount account{Channels()};
  account.Add(Channels().status, bytes);
  (void)account.Text();
  NavOutput nav;
  (void)DecodeOdometry(bytes, nav);
  FilterReport filter;
  (void)DecodeFilterState(bytes, filter);
  ScanReport scan;
  (void)DecodeRegistration(bytes, scan);
  StatusReport status;
  (void)DecodeStatusReport(bytes, status);
}

void EventLog(ByteView bytes) {
  EventLogReader reader(ScratchFile("log.lcm", bytes));
  LogEvent event;
  std::size_t num_bytes = 0;
  constexpr std::size_t kHeaderBytes = 28;
  while (reader.Next(event)) num_bytes += kHeaderBytes + event.channel.size() + event.data.size();
  if (num_bytes + static_cast<std::size_t>(reader.skipped_bytes()) != bytes.size()) std::abort();
}

void Map(ByteView bytes) {
  for (const char* name : {"map.pcd", "map.ply"}) {
    MayRefuse([&] { (void)LoadMapPoints(ScratchFile(name, bytes)); });
  }
}

void Trajectory(ByteView bytes) {
  MayRefuse([&] {
    const lio::Trajectory read = ReadTrajectory(ScratchFile("trajectory.tum", bytes));
    for (std::size_t i = 1; i < read.poses.size(); ++i) {
      if (read.poses[i].stamp <= read.poses[i - 1].stamp) std::abort();
    }
  });
}

void Config(ByteView bytes) {
  const LoadResult loaded = LoadOptions({ScratchFile("config.yaml", bytes)}, {});
  if (!loaded.faults.empty()) return;
  // Options that were accepted are printed and read again without a fault.
  const std::string text = PrintOptions(loaded.options);
  const ByteView printed(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!LoadOptions({ScratchFile("printed.yaml", printed)}, {}).faults.empty()) std::abort();
}

}  // namespace lio::fuzz
