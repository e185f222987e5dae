// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-log calibrate: estimates clock offset and rotation between lidar and IMU from a log
// (docs/calibration.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "lio/calib/rotation_calibration.hpp"
#include "lio/calib/scan_poses.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/log_input.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/progress_bar.hpp"

namespace lio {
namespace {

constexpr const char* kAboutCalibrate =
    "Estimates the clock offset and the rotation between lidar and IMU, with standard deviations:\n"
    "those that make the rotations of lidar-only odometry agree with the gyro's. The log needs\n"
    "motion; half a minute of walking with turns about all axes is enough. The result is always\n"
    "printed; it is not written with --rig, and the program ends with 5, when the motion does not\n"
    "determine the offset to 1 ms and the rotation to 0.2 deg. The translation is not estimated:\n"
    "it is taken from rig.T_imu_lidar of the configuration, whose rotation is not used.\n\n"
    "Example:\n"
    "  lio-log calibrate walk.lcm --config my_rig.yaml --rig calibrated.yaml";

constexpr double kDegrees = 180.0 / M_PI;

// Holds the results of a pass over the log.
struct Pass {
  std::vector<ImuSample> samples;
  StampedPoses sweeps;  // T_map_lidar at the middle of each sweep
  int num_unmatched = 0;
  std::int64_t num_chunks = 0;
  std::int64_t num_skipped_bytes = 0;
  std::int64_t num_refused = 0;
};

Pass ReadLog(const CalibrateArguments& arguments, const Options& options, int number,
             const SweepPath* path) {
  LogInputOptions input_options;
  input_options.channels = Channels(arguments.channel_prefix);
  input_options.start_s = arguments.start_s;
  if (arguments.duration_s > 0) input_options.duration_s = arguments.duration_s;
  input_options.reads_ahead = true;
  LogInput input(arguments.log, input_options);
  ProgressBar bar(fmt::format("pass {} of {}", number, arguments.num_passes), input.size_bytes());
  ScanPoses poses(options, path);
  Pass pass;
  while (std::optional<InputItem> item = input.Next()) {
    bar.Update(item->position_bytes);
    if (const auto* sample = std::get_if<ImuSample>(&item->data)) {
      const bool is_next = pass.samples.empty() || sample->stamp > pass.samples.back().stamp;
      if (is_next && sample->w_imu_radps.allFinite()) pass.samples.push_back(*sample);
    } else {
      ++pass.num_chunks;
      poses.Add(std::get<ScanChunk>(std::move(item->data)));
    }
  }
  poses.Finish();
  pass.sweeps = poses.found();
  pass.num_unmatched = poses.num_unmatched();
  pass.num_skipped_bytes = input.num_skipped_bytes();
  pass.num_refused = input.counters().TotalRefused();
  return pass;
}

// Returns the path of the lidar: poses from matching, angular rates from the gyro, expressed in the
// lidar frame and in the lidar's clock.
SweepPath PathOf(const Pass& pass, const RotationCalibration& found) {
  std::vector<ImuSample> rates;
  const Quaternion R_lidar_imu = found.R_imu_lidar.conjugate();
  const Duration offset = Duration::FromSeconds(found.offset_s);
  for (const ImuSample& sample : pass.samples) {
    const Vector3 w_imu_radps = sample.w_imu_radps - found.gyro_bias_radps;
    rates.push_back({sample.stamp - offset, R_lidar_imu * w_imu_radps, Vector3::Zero()});
  }
  return {pass.sweeps, std::move(rates)};
}

RotationCalibrationResult Calibrate(const CalibrateArguments& arguments, const Pass& pass) {
  std::vector<SweepRotation> rotations;
  for (const StampedPose& sweep : pass.sweeps) {
    rotations.push_back({sweep.stamp, sweep.pose.rotation});
  }
  RotationCalibrationOptions options;
  options.max_offset_s = arguments.max_offset_s;
  return CalibrateRotation(pass.samples, rotations, options);
}

Vector3 RotationStdDeg(const RotationCalibration& found) {
  return kDegrees * found.rotation_cov.diagonal().cwiseSqrt();
}

std::optional<double> ChangeDeg(const RotationCalibration& found, const Options& options) {
  if (!options.rig.T_imu_lidar) return std::nullopt;
  const Quaternion configured = options.rig.T_imu_lidar->rotation;
  return kDegrees * LogSo3(configured.conjugate() * found.R_imu_lidar).norm();
}

void Print(const RotationCalibration& found, const Options& options, const Pass& pass) {
  const Quaternion& q = found.R_imu_lidar;
  const Vector3 std_deg = RotationStdDeg(found);
  const Vector3& bias = found.gyro_bias_radps;
  fmt::print(
      "clock:    lidar stamps are {:.3f} ms {} the IMU's (1 sigma {:.3f} ms): add offset_s "
      "{:.6f} to them\n",
      1e3 * std::abs(found.offset_s), found.offset_s < 0 ? "ahead of" : "behind",
      1e3 * found.offset_std_s, found.offset_s);
  fmt::print(
      "rotation: rig.T_imu_lidar.rotation_wxyz [{:.8f}, {:.8f}, {:.8f}, {:.8f}] (1 sigma {:.4f} "
      "{:.4f} {:.4f} deg about the lidar's axes)\n",
      q.w(), q.x(), q.y(), q.z(), std_deg.x(), std_deg.y(), std_deg.z());
  if (const auto change_deg = ChangeDeg(found, options)) {
    const double std_deg_total = std::max(1e-9, std_deg.norm());
    fmt::print("          this is {:.3f} deg from the configuration's rotation, {:.1f} sigma\n",
               *change_deg, *change_deg / std_deg_total);
  }
  fmt::print("gyro:     bias [{:.5f}, {:.5f}, {:.5f}] rad/s\n", bias.x(), bias.y(), bias.z());
  fmt::print(
      "data:     {} rotations between sweeps, {:.2f} rad/s rms, correlation {:.4f}; rotation of a "
      "sweep {:.4f} deg (1 sigma); residual scale {:.2f}; {} sweeps not matched\n",
      found.num_turns, found.turn_rate_rms_radps, found.correlation, kDegrees * found.sweep_std_rad,
      found.residual_ratio, pass.num_unmatched);
}

void WriteJson(const std::string& file, const RotationCalibrationResult& result,
               const Options& options) {
  const RotationCalibration& found = *result.found;
  const auto list = [](const Vector3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  const Quaternion& q = found.R_imu_lidar;
  nlohmann::ordered_json json;
  json["is_sure"] = result.is_sure();
  json["offset_s"] = found.offset_s;
  json["offset_std_s"] = found.offset_std_s;
  json["rotation_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  json["rotation_std_deg"] = list(RotationStdDeg(found));
  if (const auto change_deg = ChangeDeg(found, options)) {
    json["rotation_from_configured_deg"] = *change_deg;
  }
  json["gyro_bias_radps"] = list(found.gyro_bias_radps);
  json["gyro_bias_std_radps"] = list(found.gyro_bias_std_radps);
  json["num_turns"] = found.num_turns;
  json["turn_rate_rms_radps"] = found.turn_rate_rms_radps;
  json["correlation"] = found.correlation;
  json["sweep_std_deg"] = kDegrees * found.sweep_std_rad;
  json["turn_std_deg"] = kDegrees * found.turn_std_rad;
  json["residual_ratio"] = found.residual_ratio;
  WriteText(file, json.dump(2) + "\n", OutputFile::Links::kFollowed);
}

void WriteRig(const std::string& file, const RotationCalibration& found, const Pose& configured) {
  const Vector3& t = configured.translation;
  const Quaternion& q = found.R_imu_lidar;
  const Vector3 std_deg = RotationStdDeg(found);
  WriteText(file,
            fmt::format("# lio-log calibrate found: rotation to {:.4f} {:.4f} {:.4f} deg (1 sigma, "
                        "lidar's axes); translation as configured.\n"
                        "# Clock offset to {:.6f} s (1 sigma).\n"
                        "rig:\n"
                        "  T_imu_lidar:  # p_imu = T_imu_lidar * p_lidar\n"
                        "    translation_m: [{:.9g}, {:.9g}, {:.9g}]\n"
                        "    rotation_wxyz: [{:.10f}, {:.10f}, {:.10f}, {:.10f}]\n"
                        "  lidar:\n"
                        "    clock_offset_s: {:.6f}  # added to the lidar's stamps\n",
                        std_deg.x(), std_deg.y(), std_deg.z(), found.offset_std_s, t.x(), t.y(),
                        t.z(), q.w(), q.x(), q.y(), q.z(), found.offset_s),
            OutputFile::Links::kFollowed);
}

// Loads the options; nothing means go on. The rotation need not be configured: it is estimated.
std::optional<int> Configure(const CalibrateArguments& arguments, Options& options) {
  std::vector<std::string> sets = arguments.options.sets;
  sets.emplace_back("pipeline.use_imu=false");
  const LoadResult loaded = LoadOptions(arguments.options.files, sets);
  if (arguments.options.print) fmt::print("{}", PrintOptions(loaded.options));
  for (const std::string& fault : loaded.faults) fmt::print(stderr, "lio-log: {}\n", fault);
  if (!loaded.faults.empty()) return kExitConfiguration;
  if (arguments.options.print) return kExitDone;
  options = loaded.options;
  if (arguments.rig_file.empty() || options.rig.T_imu_lidar) return std::nullopt;
  fmt::print(stderr,
             "lio-log: --rig needs rig.T_imu_lidar in a --config file: the translation is taken "
             "from it, because calibration estimates only the rotation\n");
  return kExitConfiguration;
}

// Says why calibration cannot be tried; empty when it can.
std::string MissingInput(const CalibrateArguments& arguments, const Pass& pass) {
  const std::string& prefix = arguments.channel_prefix;
  std::string missing;
  if (pass.samples.empty()) missing = prefix + "IMU";
  if (pass.num_chunks == 0) missing += (missing.empty() ? "" : " and ") + prefix + "SCAN";
  if (missing.empty()) return {};
  return fmt::format("the log has no messages on {}; list its channels with 'lio-log info'",
                     missing);
}

int Refuse(const CalibrateArguments& arguments, const std::string& why) {
  fmt::print(stderr, "lio-log: {}: {}\n", arguments.log, why);
  return kExitUnusableInput;
}

}  // namespace

CLI::App* AddCalibrateCommand(CLI::App& app, CalibrateArguments& arguments) {
  CLI::App* command = app.add_subcommand("calibrate", kAboutCalibrate);
  command->add_option("LOG", arguments.log, "LCM log with LIO_IMU and LIO_SCAN")
      ->type_name("IN.lcm")
      ->required();
  command->add_option("--json", arguments.json_file, "Write the result as JSON too")
      ->type_name("FILE");
  command->add_option("--rig", arguments.rig_file, "Write the result as a configuration file")
      ->type_name("OUT.yaml");
  AddSpanArguments(*command, arguments.start_s, arguments.duration_s);
  command->add_option("--max-offset", arguments.max_offset_s, "Search for offsets up to this [s]")
      ->type_name("S")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--passes", arguments.num_passes, "Match the whole log this many times")
      ->type_name("N")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  arguments.channel_prefix = kDefaultChannelPrefix;
  command
      ->add_option("--channel-prefix", arguments.channel_prefix,
                   "First part of the channels' names")
      ->type_name("NAME")
      ->capture_default_str();
  AddOptionsArguments(*command, arguments.options);
  return command;
}

int RunCalibrate(const CalibrateArguments& arguments) {
  Options options;
  if (const auto exit_code = Configure(arguments, options)) return *exit_code;
  Paths inputs = arguments.options.files;
  inputs.emplace_back(arguments.log);
  RefuseToOverwrite(inputs, {arguments.json_file, arguments.rig_file});
  Pass pass = ReadLog(arguments, options, 1, nullptr);
  if (const std::string missing = MissingInput(arguments, pass); !missing.empty()) {
    return Refuse(arguments, missing);
  }
  RotationCalibrationResult result = Calibrate(arguments, pass);
  // The first pass deskews by constant velocity; the others deskew along the path that was found.
  for (int number = 2; number <= arguments.num_passes && result.found; ++number) {
    const SweepPath path = PathOf(pass, *result.found);
    pass = ReadLog(arguments, options, number, &path);
    result = Calibrate(arguments, pass);
  }
  if (!result.found) {
    return Refuse(arguments, fmt::format("not calibrated: {} ({} sweeps matched, {} not)",
                                         result.why_not, pass.sweeps.size(), pass.num_unmatched));
  }
  Print(*result.found, options, pass);
  if (!arguments.json_file.empty()) WriteJson(arguments.json_file, result, options);
  if (!result.is_sure()) return Refuse(arguments, "not sure: " + result.why_not);
  if (!arguments.rig_file.empty()) {
    WriteRig(arguments.rig_file, *result.found, *options.rig.T_imu_lidar);
  }
  if (pass.num_skipped_bytes + pass.num_refused == 0) return kExitDone;
  return Refuse(arguments,
                fmt::format("the log is damaged: {} bytes skipped, {} messages refused; the "
                            "rest was used",
                            pass.num_skipped_bytes, pass.num_refused));
}

}  // namespace lio
