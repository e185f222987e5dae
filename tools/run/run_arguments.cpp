// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "run_arguments.hpp"

#include <CLI/CLI.hpp>

namespace lio {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  lio-run drive.bag --out out/drive\n"
    "  lio-run drive.bag --rig out/drive/rig_draft.yaml --out out/drive --overwrite\n"
    "  lio-run ros2_folder --lidar-topic /velodyne_points --truth truth.tum --out out/ros2\n"
    "  lio-run 2011_09_26/2011_09_26_drive_0005_sync --out out/kitti\n"
    "  lio-run out/live --truth truth.tum\n"
    "  lio-run out/loam out/gicp --out out/compared\n\n"
    "Exit codes: 0 done, 2 usage (also an ambiguous topic), 3 configuration (also one that the\n"
    "data contradict), 5 damaged, missing or unusable input (its sound parts were run), 6 done,\n"
    "but the result cannot be trusted: verdict.json, the summary and the page say why and what to\n"
    "change, 74 a file or stdout could not be written in full.";

}  // namespace

const char* const kAbout =
    "Runs odometry over a recording of any kind and leaves a folder with the result.\n\n"
    "INPUT is recognised by its content: a ROS 1 bag (or the folder of its parts), a ROS 2 bag\n"
    "(its folder, one .db3 or one .mcap), a pcap of Velodyne or Ouster packets, a KITTI raw "
    "drive,\n"
    "a KITTI odometry sequence, an LCM log, or a folder that lio-sim wrote. It is converted,\n"
    "replayed, and scored where there is a truth. DIR then has all that 'lio-replay --map'\n"
    "writes, report.html (plots of all that matters, for any browser, no network needed), the log\n"
    "and conversion.txt of what was no log, and with a truth eval.txt and eval.json.\n\n"
    "Without --rig a rig is drafted from what the recording shows, as DIR/rig_draft.yaml: the\n"
    "lidar by its beams, the extrinsic from /tf_static, else none; what is assumed is told. The\n"
    "rig of another vehicle is never taken. Correct the draft and run again with --rig; where the\n"
    "verdict knows the right lines, DIR/rig_corrected.yaml has them already.\n\n"
    "A run's folder as INPUT gets its report.html anew. Several such folders make one page that\n"
    "compares them, DIR/report.html.";

void AddArguments(CLI::App& app, RunArguments& arguments) {
  app.footer(kExamples);
  app.add_option("INPUT", arguments.inputs,
                 "Recording, or the folder of a finished run; several such folders make one page")
      ->required();
  app.add_option("--out", arguments.out, "Folder for the results; it must be empty or new")
      ->type_name("DIR");
  app.add_flag("--overwrite", arguments.overwrites, "Replace the files of an earlier run in DIR");
  app.add_option("--rig", arguments.rig,
                 "The vehicle's configuration, which --config overrides (default: a draft is made)")
      ->type_name("FILE");
  app.add_option("--truth", arguments.truth,
                 "True trajectory as TUM file (default: beside INPUT, else from it)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile.description(""));
  app.add_option("--lidar-topic", arguments.lidar_topic,
                 "Topic of a bag's PointCloud2 or CustomMsg, or a capture's sensor, ADDRESS:PORT")
      ->type_name("NAME");
  app.add_option("--imu-topic", arguments.imu_topic, "Topic of a bag's Imu")->type_name("NAME");
  app.add_option("--imu", arguments.imu_file,
                 "Log, bag or table of the IMU beside a network capture (default: DRIVE.imu.*)")
      ->type_name("FILE");
  app.add_option("--truth-topic", arguments.truth_topic, "Topic of a bag's truth")
      ->type_name("NAME");
  app.add_option("--threads", arguments.num_threads, "Instead of pipeline.num_threads")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  AddPassesArgument(app, arguments.num_passes);
  AddSpanArguments(app, arguments.start_s, arguments.duration_s);
  AddOptionsArguments(app, arguments.options);
}

}  // namespace lio
