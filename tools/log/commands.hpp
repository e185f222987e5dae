// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The subcommands of lio-log: each adds its arguments to the program, and runs after parsing.
#pragma once

#include <optional>
#include <string>

#include "lio/io/command_line.hpp"

namespace lio {

struct InfoArguments {
  std::string log;
  std::string channel_prefix;
};
CLI::App* AddInfoCommand(CLI::App& app, InfoArguments& arguments);
int RunInfo(const InfoArguments& arguments);

struct CalibrateArguments {
  OptionsArguments options;
  std::string log;
  std::string channel_prefix;
  std::string json_file;
  std::string rig_file;
  double start_s = 0.0;
  double duration_s = 0.0;  // 0 means to the end of the log
  double max_offset_s = 0.5;
  int num_passes = 3;
};
CLI::App* AddCalibrateCommand(CLI::App& app, CalibrateArguments& arguments);
int RunCalibrate(const CalibrateArguments& arguments);

struct DoctorArguments {
  OptionsArguments options;
  std::string input;
  std::string json_file;
  std::string rig_file;
  std::string lidar_topic;
  std::string imu_topic;
  std::optional<int> num_threads;
  double start_s = 0.0;
  double duration_s = 0.0;  // 0 means to the end of the recording
  int num_passes = 3;
};
CLI::App* AddDoctorCommand(CLI::App& app, DoctorArguments& arguments);
int RunDoctor(const DoctorArguments& arguments);

struct ExportArguments {
  std::string log;
  std::string channel_prefix;
  std::string mcap_file;
  std::string csv_folder;
  std::string ply_file;
  std::string tum_file;
  std::string compression = "zstd";
  bool with_inputs = false;
};
CLI::App* AddExportCommand(CLI::App& app, ExportArguments& arguments);
int RunExport(const ExportArguments& arguments);

}  // namespace lio
