// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-log export writes liod's messages of a log as files that other programs open
// (docs/export.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "commands.hpp"
#include "lio/export/export_log.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/progress_bar.hpp"

namespace lio {
namespace {

constexpr const char* kAboutExport =
    "Writes what a log has of liod's messages into files that other programs open: MCAP for\n"
    "Foxglove and Lichtblick (path, clouds, pose with covariance, frames, notices, plots), "
    "tables,\n"
    "the map's points, and the path. Several may be asked for at once.\n\n"
    "Examples:\n"
    "  lio-log export recorded.lcm --mcap recorded.mcap\n"
    "  lio-log export recorded.lcm --csv tables --ply map.ply --tum path.tum";

using Export = ExportCounts (*)(const std::filesystem::path&, const std::filesystem::path&,
                                const ExportOptions&);

struct Job {
  Export run;
  const char* name;
  std::filesystem::path out;
};

std::vector<Job> JobsOf(const ExportArguments& arguments) {
  std::vector<Job> jobs;
  const auto add = [&](Export run, const char* name, const std::string& out) {
    if (out.empty()) return;
    RefuseToOverwrite({arguments.log}, {out});
    jobs.push_back({run, name, out});
  };
  add(&ExportMcap, "mcap", arguments.mcap_file);
  add(&ExportCsv, "csv", arguments.csv_folder);
  add(&ExportPly, "ply", arguments.ply_file);
  add(&ExportTum, "tum", arguments.tum_file);
  if (jobs.empty()) throw UsageError("name what to write: --mcap, --csv, --ply or --tum");
  return jobs;
}

McapCompression CompressionOf(const std::string& name) {
  if (name == "none") return McapCompression::kNone;
  return name == "lz4" ? McapCompression::kLz4 : McapCompression::kZstd;
}

// True when all of the log and of its messages was sound.
bool RunJob(const Job& job, const ExportArguments& arguments) {
  ExportOptions options;
  options.channel_prefix = arguments.channel_prefix;
  options.with_inputs = arguments.with_inputs;
  options.compression = CompressionOf(arguments.compression);
  ProgressBar bar(job.name, EventLogReader(arguments.log).size_bytes());
  options.progress = [&bar](std::int64_t at, std::int64_t) { bar.Update(at); };
  const ExportCounts counts = job.run(arguments.log, job.out, options);
  fmt::print("{:5} {}: {} messages{}\n", job.name, job.out.string(), counts.num_messages,
             counts.num_points > 0 ? fmt::format(", {} points", counts.num_points) : "");
  if (counts.num_refused > 0) {
    fmt::print(stderr, "lio-log: {}: {} malformed messages were left out\n", arguments.log,
               counts.num_refused);
  }
  if (counts.skipped_bytes > 0) {
    fmt::print(stderr, "lio-log: {}: {} damaged bytes were passed over\n", arguments.log,
               counts.skipped_bytes);
  }
  return counts.num_refused == 0 && counts.skipped_bytes == 0;
}

}  // namespace

CLI::App* AddExportCommand(CLI::App& app, ExportArguments& arguments) {
  CLI::App* command = app.add_subcommand("export", kAboutExport);
  command->add_option("LOG", arguments.log, "LCM log with liod's messages")
      ->type_name("IN.lcm")
      ->required();
  command->add_option("--mcap", arguments.mcap_file, "MCAP file to write")->type_name("FILE");
  command->add_option("--csv", arguments.csv_folder, "folder for tables")->type_name("DIR");
  command->add_option("--ply", arguments.ply_file, "points of the map to write")->type_name("FILE");
  command->add_option("--tum", arguments.tum_file, "path in world to write")->type_name("FILE");
  command->add_option("--compression", arguments.compression, "compression of the MCAP file")
      ->type_name("zstd|lz4|none")
      ->capture_default_str()
      ->check(CLI::IsMember({"zstd", "lz4", "none"}).description(""));
  command->add_flag("--inputs", arguments.with_inputs,
                    "MCAP: the inertial samples and the sweeps as they came, too");
  arguments.channel_prefix = kDefaultChannelPrefix;
  command->add_option("--channel-prefix", arguments.channel_prefix, "prefix of liod's channels")
      ->type_name("TEXT")
      ->capture_default_str();
  return command;
}

int RunExport(const ExportArguments& arguments) {
  RefuseIrregular(arguments.log);
  if (const std::string why = WhyNoLog(arguments.log); !why.empty()) throw InputError(why);
  bool is_sound = true;
  for (const Job& job : JobsOf(arguments)) is_sound = RunJob(job, arguments) && is_sound;
  return is_sound ? kExitDone : kExitUnusableInput;
}

}  // namespace lio
