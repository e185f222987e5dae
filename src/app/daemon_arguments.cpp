// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/daemon_arguments.hpp"

#include <CLI/CLI.hpp>

#include "lio/io/run_folder.hpp"

namespace lio {
namespace {

// A channel name of LCM has at most 63 characters, and the longest of ours adds less than 23.
constexpr std::size_t kMaxPrefixCharacters = 40;

constexpr const char* kDescription =
    "LiDAR-inertial odometry over LCM.\n\n"
    "Listens on LIO_IMU and LIO_SCAN. Publishes LIO_ODOM (once per scan, in the level frame\n"
    "world), LIO_ODOM_LOCAL (once per scan, in the frame map, which never turns), LIO_ODOM_IMU\n"
    "(once per inertial sample), LIO_STATE, LIO_REG, LIO_STATUS (1 Hz), LIO_CLOUD (2 Hz, thinned)\n"
    "and, when asked for, LIO_CLOUD_FULL. Runs until SIGINT or SIGTERM, then ends within a second.";

constexpr const char* kExamples =
    "Examples:\n"
    "  liod --config config/ulhk.yaml --out out/live &\n"
    "  lcm-logplayer drive.lcm                    # in another terminal; then: lio-spy\n"
    "  liod --config config/default.yaml --config my_rig.yaml --lcm-url "
    "'udpm://239.255.76.67:7700'\n"
    "  liod --check --config config/default.yaml --config my_rig.yaml --out out/live\n\n"
    "Without a multicast route: sudo ip link set lo up && sudo ip route add 224.0.0.0/4 dev lo\n"
    "Exit codes: 0 done, 2 usage, 3 configuration, 4 no transport, 5 unusable initial map,\n"
    "6 done, but the files of --out cannot be trusted (verdict.json and the log say why),\n"
    "70 internal fault (the files of --out are complete up to it), 74 a file of --out could not "
    "be\n"
    "written in full: the estimate went on, the files end there.";

}  // namespace

void DaemonArguments::AddTo(CLI::App& app) {
  app.description(kDescription);
  app.footer(kExamples);
  app.add_option("--lcm-url", lcm_url,
                 "LCM transport; the default is LCM_DEFAULT_URL or else LCM's multicast group")
      ->type_name("URL");
  app.add_option("--out", out,
                 "Write the files that lio-replay writes, and report.html at the end, into this\n"
                 "folder or, when it holds an earlier run, into the first of DIR-2, DIR-3 and so "
                 "on that holds none")
      ->type_name("DIR");
  app.add_flag("--overwrite", overwrites, "Replace the files of an earlier run in DIR (--out)");
  app.add_flag("--map", writes_map, "Write map.pcd into DIR at the end, too");
  AddInitialMapArguments(app, initial_map);
  app.add_flag("--cloud-full", publishes_full_cloud,
               "Publish every point, in the frame map, on LIO_CLOUD_FULL; LIO_CMD may change it");
  app.add_option("--channel-prefix", channel_prefix,
                 "First part of every channel's name, in and out")
      ->type_name("NAME")
      ->check(NameUpTo(kMaxPrefixCharacters))
      ->capture_default_str();
  app.add_flag(
      "--check", checks_only,
      "Validate arguments, configuration, map and folder, say what would be used, and exit\n"
      "with the code that a start would end with; opens no network and writes nothing");
  AddOptionsArguments(app, options);
}

LiveOptions DaemonArguments::Live() const {
  LiveOptions live;
  live.channels = Channels(channel_prefix);
  live.lcm_url = lcm_url;
  if (!out.empty()) live.out = out;
  live.writes_map = writes_map && live.out;
  live.publishes_full_cloud = publishes_full_cloud;
  return live;
}

Paths DaemonArguments::Inputs() const {
  Paths inputs = options.files;
  inputs.push_back(initial_map.map);
  return inputs;
}

std::filesystem::path DaemonArguments::FolderOfFiles() const {
  return out.empty() || overwrites ? std::filesystem::path(out) : FreeFolder(out);
}

std::string DaemonArguments::WhyInputIsLost() const {
  return out.empty() ? "" : lio::WhyInputIsLost(Inputs(), FilesOfRun(FolderOfFiles()));
}

}  // namespace lio
