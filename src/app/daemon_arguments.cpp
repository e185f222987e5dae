// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/daemon_arguments.hpp"

#include <CLI/CLI.hpp>

namespace lio {
namespace {

// LCM's channel names have at most 63 characters; the longest of ours adds less than 23.
constexpr std::size_t kMaxPrefixCharacters = 40;

constexpr const char* kDescription =
    "LiDAR-inertial odometry over LCM.\n\n"
    "Listens on LIO_IMU and LIO_SCAN; publishes LIO_ODOM (once a scan, level), LIO_ODOM_LOCAL\n"
    "(the steady path), LIO_ODOM_IMU (once an inertial sample), LIO_STATE, LIO_REG, LIO_STATUS\n"
    "(1 Hz), LIO_CLOUD (2 Hz, thinned) and, when asked for, LIO_CLOUD_FULL. Runs until SIGINT or\n"
    "SIGTERM, then ends within a second.";

constexpr const char* kExamples =
    "Examples:\n"
    "  liod --config config/ulhk.yaml --out out/live &\n"
    "  lcm-logplayer drive.lcm                    # in another terminal; then: lio-spy\n"
    "  liod --config config/default.yaml --config my_rig.yaml --lcm-url "
    "'udpm://239.255.76.67:7700'\n\n"
    "Without a multicast route: sudo ip link set lo up && sudo ip route add 224.0.0.0/4 dev lo\n"
    "Exit codes: 0 done, 2 usage, 3 configuration, 4 no transport.";

}  // namespace

void DaemonArguments::AddTo(CLI::App& app) {
  app.description(kDescription);
  app.footer(kExamples);
  app.add_option("--lcm-url", lcm_url,
                 "LCM transport; without it LCM_DEFAULT_URL, else LCM's default multicast group")
      ->type_name("URL");
  app.add_option("--out", out, "Folder for the files that lio-replay writes too")->type_name("DIR");
  app.add_flag("--map", writes_map, "With --out: write map.pcd at the end");
  app.add_flag("--cloud-full", publishes_full_cloud,
               "Publish every point, registered, on LIO_CLOUD_FULL; LIO_CMD may change it");
  app.add_option("--channel-prefix", channel_prefix, "Of all channels, in and out")
      ->type_name("NAME")
      ->check(NameUpTo(kMaxPrefixCharacters))
      ->capture_default_str();
  AddOptionsArguments(app, options);
}

LiveOptions DaemonArguments::Live() const {
  LiveOptions live;
  live.channels = Channels(channel_prefix);
  if (!out.empty()) live.out = out;
  live.writes_map = writes_map && live.out;
  live.publishes_full_cloud = publishes_full_cloud;
  return live;
}

}  // namespace lio
