// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-log, the command line; the files *_command.cpp do the work.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "lio/io/program.hpp"

namespace {

constexpr const char* kAbout =
    "Shows the contents of LCM logs, exports them, calibrates a sensor set-up from them, and says\n"
    "what is wrong with one.\n\n"
    "Examples:\n"
    "  lio-log info drive.lcm\n"
    "  lio-log calibrate drive.lcm --config config/ulhk.yaml\n"
    "  lio-log calibrate walk.lcm --config my_rig.yaml --json out.json --rig calibrated.yaml\n"
    "  lio-log doctor drive.bag --write-rig rig.yaml\n"
    "  lio-log export recorded.lcm --mcap recorded.mcap\n\n"
    "Exit codes: 0 done, 2 usage, 3 configuration, 5 damaged, missing or unusable log, 6 doctor\n"
    "leaves no trust in the result,\n"
    "74 a file or stdout could not be written in full.";

int Main(int argc, char** argv) {
  CLI::App app(kAbout, "lio-log");
  app.require_subcommand(1);
  lio::InfoArguments info;
  lio::CalibrateArguments calibrate;
  const CLI::App* info_command = AddInfoCommand(app, info);
  lio::DoctorArguments doctor;
  AddCalibrateCommand(app, calibrate);
  const CLI::App* doctor_command = AddDoctorCommand(app, doctor);
  lio::ExportArguments export_arguments;
  const CLI::App* export_command = AddExportCommand(app, export_arguments);
  if (const auto exit_code = lio::ParseCommandLine(app, argc, argv, LIO_VERSION)) {
    return *exit_code;
  }
  if (doctor_command->parsed()) return RunDoctor(doctor);
  if (export_command->parsed()) return RunExport(export_arguments);
  return info_command->parsed() ? RunInfo(info) : RunCalibrate(calibrate);
}

}  // namespace

int main(int argc, char** argv) {
  return lio::RunProgram("lio-log", [&] { return Main(argc, argv); });
}
