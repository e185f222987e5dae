// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// This is the command line of lio-convert, which converts recorded drives to LCM logs; lio_io does
// the work.
#include <CLI/CLI.hpp>
#include <iostream>

#include "lio/convert/kitti_odometry.hpp"
#include "lio/convert/kitti_raw.hpp"
#include "lio/convert/pcap_convert.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/program.hpp"
#include "lio/io/progress_bar.hpp"

namespace {

constexpr const char* kAbout =
    "Convert recorded drives to LCM logs that lio-replay, lcm-logplayer and liod read:\n"
    "channels LIO_IMU (lio.imu_t) and LIO_SCAN (lio.scan_t, chunks of one datagram each).\n\n"
    "Examples:\n"
    "  lio-convert rosbag drive.bag drive.lcm --truth drive.tum\n"
    "  lio-convert rosbag ros2_folder drive.lcm --lidar-topic /velodyne_points\n"
    "  lio-convert pcap drive.pcap drive.lcm --imu drive.csv\n"
    "  lio-convert kitti-raw 2011_09_26/2011_09_26_drive_0005_sync drive.lcm \\\n"
    "      --truth drive.tum --rig rig.yaml --imu-rate 100\n"
    "  lio-convert kitti-odometry sequences/05 05.lcm --truth 05.tum \\\n"
    "      --vertical-correction 0.205\n\n"
    "The summary on stdout says what was found, detected and lost. Exit codes: 0 done,\n"
    "2 usage (also an ambiguous topic), 5 damaged, missing or unusable input (a damaged\n"
    "recording is converted as far as it can be read), 74 a file or stdout could not be\n"
    "written in full.";

constexpr const char* kAboutRosbag =
    "Convert a ROS 1 bag (file), a ROS 2 bag (folder with metadata.yaml, or one .db3) or an\n"
    "MCAP file of either with sensor_msgs/PointCloud2 and sensor_msgs/Imu. Topics are found by "
    "type; unit and\n"
    "meaning of time stamps are detected from the data and printed.";

constexpr const char* kAboutPcap =
    "Convert a network capture (pcap or pcapng) of the packets of a Velodyne VLP-16 or HDL-32E or\n"
    "of an Ouster, with the Ouster's own IMU, or with an IMU's file that lies beside it: an LCM\n"
    "log, a ROS bag, or a table of stamp, wx, wy, wz [rad/s], ax, ay, az [m/s^2].";

constexpr const char* kAboutRaw =
    "Convert a KITTI raw drive, synchronised or extract release. Point times are computed\n"
    "from azimuth, the truth's positions from integrated velocity, and the rig from the\n"
    "day's calibration.";

constexpr const char* kAboutOdometry =
    "Convert a KITTI odometry sequence: velodyne/, times.txt, calib.txt. The poses (default\n"
    "../../poses/NN.txt) are converted from the camera's frame to the lidar's.";

// No output may replace what is read, and results or logs need not be converted: the first of the
// inputs is the recording.
void Guard(const lio::Paths& inputs, const lio::Paths& outputs) {
  lio::RefuseToOverwrite(inputs, outputs);
  const std::string why = lio::WhyNoRecording(inputs.front());
  if (!why.empty()) throw lio::InputError(why);
}

// Shows a progress bar while `convert` runs, then its summary; the exit code says whether something
// was lost.
template <typename Options, typename Convert>
int Run(Options& options, Convert&& convert) {
  const auto report = [&] {
    constexpr std::int64_t kSteps = 1000;
    lio::ProgressBar bar("convert", kSteps);
    options.progress = [&bar](double share) {
      bar.Update(static_cast<std::int64_t>(share * static_cast<double>(kSteps)));
    };
    return convert(options);
  }();
  std::cout << FormatReport(report, options);
  if (!report.IsDamaged()) return lio::kExitDone;
  std::cerr
      << "lio-convert: the input is damaged: its sound parts were converted, see the summary\n";
  return lio::kExitUnusableInput;
}

CLI::App* AddRosbag(CLI::App& app, lio::RosbagOptions& options) {
  using lio::StampMeaning;
  using lio::TimeUnit;
  CLI::App* command = app.add_subcommand("rosbag", kAboutRosbag);
  command->add_option("IN", options.input, "Bag to convert")->required();
  command->add_option("OUT.lcm", options.output, "The log to write")->required();
  command->add_option("--lidar-topic", options.lidar_topic,
                      "Topic of the PointCloud2 or CustomMsg messages");
  command->add_option("--imu-topic", options.imu_topic, "Topic of the Imu messages");
  auto* truth = command->add_option("--truth", options.truth_file, "Write the truth, as TUM file");
  command
      ->add_option("--truth-topic", options.truth_topic,
                   "Topic of the truth: Odometry, PoseStamped or INSPVAX")
      ->needs(truth);
  command->add_option(
      "--lidar", options.lidar_model,
      "Lidar model (hdl32e, vlp16, hdl64e, os1_64), which gives rings and direction "
      "if the clouds do not");
  const std::map<std::string, std::optional<TimeUnit>> units = {{"auto", std::nullopt},
                                                                {"s", TimeUnit::kSeconds},
                                                                {"ms", TimeUnit::kMilliseconds},
                                                                {"us", TimeUnit::kMicroseconds},
                                                                {"ns", TimeUnit::kNanoseconds}};
  const std::map<std::string, std::optional<StampMeaning>> stamps = {
      {"auto", std::nullopt},
      {"start", StampMeaning::kSweepStart},
      {"end", StampMeaning::kSweepEnd}};
  command
      ->add_option_function<std::string>(
          "--point-time",
          [units, &options](const std::string& name) { options.point_time.unit = units.at(name); },
          "Unit of the point times: auto, s, ms, us, ns")
      ->check(CLI::IsMember(units));
  command
      ->add_option_function<std::string>(
          "--stamp",
          [stamps, &options](const std::string& name) {
            options.point_time.stamp = stamps.at(name);
          },
          "Instant of the sweep that a cloud's stamp gives: auto, start, end")
      ->check(CLI::IsMember(stamps));
  command
      ->add_option("--start", options.start_s,
                   "Begin this many seconds after the bag's first message")
      ->check(lio::NumberFromZero());
  command->add_option("--duration", options.duration_s, "Convert only this many seconds")
      ->check(lio::NumberAboveZero());
  command->add_flag("--whole-scans", options.whole_scans,
                    "Write one message per sweep instead of chunks");
  return command;
}

CLI::App* AddPcap(CLI::App& app, lio::PcapOptions& options) {
  CLI::App* command = app.add_subcommand("pcap", kAboutPcap);
  command->add_option("IN.pcap", options.input, "Capture to convert")->required();
  command->add_option("OUT.lcm", options.output, "The log to write")->required();
  command->add_option("--sensor", options.sensor,
                      "The lidar, where several are: ADDRESS:PORT, e.g. 192.168.1.201:2368");
  command->add_option(
      "--imu", options.imu,
      "Log, bag or table of the IMU (default: IN.imu.csv, .lcm, .bag, .db3, .mcap)");
  command->add_option("--metadata", options.metadata,
                      "Description of an Ouster sensor (default: IN.json)");
  command->add_flag("--whole-scans", options.whole_scans,
                    "Write one message per sweep instead of chunks");
  return command;
}

CLI::App* AddKittiRaw(CLI::App& app, lio::KittiRawOptions& options) {
  CLI::App* command = app.add_subcommand("kitti-raw", kAboutRaw);
  command->add_option("DRIVE_DIR", options.drive, "The drive's folder")->required();
  command->add_option("OUT.lcm", options.output, "The log to write")->required();
  command->add_option("--truth", options.truth_file, "Write the IMU's poses, as TUM file");
  command->add_option("--rig", options.rig_file, "Write the rig's configuration, as YAML file");
  command->add_option("--imu-rate", options.imu_rate_hz, "Interpolate the IMU to this rate [Hz]")
      ->check(lio::NumberWithin(1.0, 10000.0));
  return command;
}

CLI::App* AddKittiOdometry(CLI::App& app, lio::KittiOdometryOptions& options) {
  CLI::App* command = app.add_subcommand("kitti-odometry", kAboutOdometry);
  command->add_option("SEQUENCE_DIR", options.sequence, "The sequence's folder")->required();
  command->add_option("OUT.lcm", options.output, "The log to write")->required();
  auto* truth =
      command->add_option("--truth", options.truth_file, "Write the lidar's poses, as TUM file");
  command->add_option("--poses", options.poses_file, "KITTI pose file with the camera's poses")
      ->needs(truth);
  command
      ->add_option("--vertical-correction", options.vertical_correction_deg,
                   "Raise every point's elevation [deg]; 0.205 suits KITTI's scanner")
      ->check(lio::NumberWithin(-5.0, 5.0));
  return command;
}

int Convert(int argc, char** argv) {
  CLI::App app(kAbout, "lio-convert");
  app.require_subcommand(1);
  lio::RosbagOptions rosbag;
  lio::PcapOptions pcap;
  lio::KittiRawOptions raw;
  lio::KittiOdometryOptions odometry;
  const CLI::App* rosbag_command = AddRosbag(app, rosbag);
  const CLI::App* pcap_command = AddPcap(app, pcap);
  const CLI::App* raw_command = AddKittiRaw(app, raw);
  AddKittiOdometry(app, odometry);
  if (const auto exit_code = lio::ParseCommandLine(app, argc, argv, LIO_VERSION)) {
    return *exit_code;
  }
  if (rosbag_command->parsed()) {
    Guard({rosbag.input}, {rosbag.output, rosbag.truth_file.value_or("")});
    return Run(rosbag, lio::ConvertRosbag);
  }
  if (pcap_command->parsed()) {
    Guard(InputsOf(pcap), {pcap.output});
    return Run(pcap, lio::ConvertPcap);
  }
  if (raw_command->parsed()) {
    Guard(InputsOf(raw), {raw.output, raw.truth_file.value_or(""), raw.rig_file.value_or("")});
    return Run(raw, lio::ConvertKittiRaw);
  }
  Guard(InputsOf(odometry), {odometry.output, odometry.truth_file.value_or("")});
  return Run(odometry, lio::ConvertKittiOdometry);
}

}  // namespace

int main(int argc, char** argv) {
  return lio::RunProgram("lio-convert", [&] { return Convert(argc, argv); });
}
