// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/daemon_check.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "lio/io/bus.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/run_folder.hpp"

namespace lio {
namespace {

std::string Joined(const std::vector<std::filesystem::path>& files) {
  std::string text;
  for (const auto& file : files) text += (text.empty() ? "" : ", ") + file.string();
  return text.empty() ? "no file" : text;
}

std::string WhyUnusableUrl(const std::string& url) {
  for (const char* scheme : {"udpm://", "tcpq://", "file://"}) {
    if (url.starts_with(scheme)) return {};
  }
  return "--lcm-url: " + url + " is none of udpm://, tcpq:// and file://";
}

std::string FilesText(const DaemonArguments& arguments) {
  if (arguments.out.empty()) return "none (--out)";
  return fmt::format("{}{}", arguments.FolderOfFiles().string(),
                     arguments.writes_map ? ", with map.pcd" : "");
}

std::string MapText(const DaemonArguments& arguments, const InitialMapPtr& map) {
  if (!map) return "none, the first scans begin one";
  return fmt::format("{}, {} points", arguments.initial_map.map.string(), map->points.size());
}

void PrintUse(const DaemonArguments& arguments, const Options& options, const InitialMapPtr& map) {
  const Channels channels(arguments.channel_prefix);
  fmt::print("configuration  {}, {} keys set, hash {:016x}\n", Joined(arguments.options.files),
             arguments.options.sets.size(), Fnv1a(PrintOptions(options)));
  fmt::print("sensors        lidar{}\n", options.pipeline.use_imu ? " and IMU" : " alone");
  fmt::print("listens on     {}, {} and {}\n", channels.imu, channels.scan, channels.command);
  fmt::print("publishes on   {}, {} and others of {}*\n", channels.odometry, channels.status,
             arguments.channel_prefix);
  fmt::print("LCM            {} (not opened)\n", EffectiveUrl(arguments.lcm_url));
  fmt::print("files          {}\n", FilesText(arguments));
  fmt::print("map            {}\n", MapText(arguments, map));
}

}  // namespace

int CheckDaemon(const DaemonArguments& arguments, const Options& options, bool has_faulty_options) {
  int first_code = has_faulty_options ? kExitConfiguration : kExitDone;
  const auto note = [&](int code) {
    if (first_code == kExitDone) first_code = code;
  };
  const auto tell = [&](const std::string& fault, int code) {
    if (fault.empty()) return;
    fmt::print(stderr, "liod: {}\n", fault);
    note(code);
  };
  tell(arguments.WhyInputIsLost(), kExitUsage);
  InitialMapPtr map;
  if (const auto code = LoadInitialMap("liod", arguments.initial_map, options, map)) note(*code);
  tell(WhyUnusableUrl(EffectiveUrl(arguments.lcm_url)), kExitNoTransport);
  if (!arguments.out.empty()) {
    const std::string why = WhyNotWritable(arguments.out);
    tell(why.empty() ? "" : "--out: " + why, kExitUsage);
  }
  if (first_code == kExitDone) PrintUse(arguments, options, map);
  return first_code;
}

}  // namespace lio
