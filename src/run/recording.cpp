// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/recording.hpp"

#include <fmt/format.h>

#include "draft_rig.hpp"
#include "lio/convert/kitti_odometry.hpp"
#include "lio/convert/kitti_raw.hpp"
#include "lio/convert/pcap_convert.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/convert/static_transforms.hpp"
#include "lio/io/beam_table.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/printable.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFewestTruthRows = 3;  // fewer cannot be compared

fs::path WithoutSlash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

// A trajectory beside the input is its truth by name: drive.bag, drive.gt.tum or drive.tum.
std::optional<fs::path> TruthBeside(const fs::path& input) {
  fs::path stem = WithoutSlash(input);
  stem.replace_extension();
  for (const char* ending : {".gt.tum", ".tum"}) {
    const fs::path file = stem.string() + ending;
    if (fs::is_regular_file(file)) return file;
  }
  const fs::path named = stem.parent_path() / "truth.tum";
  if (KindOf(input) == FileKind::kLcmLog && fs::is_regular_file(named)) return named;
  return std::nullopt;
}

Rig RigFrom(const std::vector<fs::path>& files) {
  const LoadResult loaded = LoadOptions(files, {});
  if (!loaded.faults.empty()) throw InputError(loaded.faults.front());
  return loaded.options.rig;
}

class Preparation {
 public:
  explicit Preparation(const RecordingRequest& request) : request_(request) {
    prepared_.log = request.out / "log.lcm";
    prepared_.truth = request.truth ? request.truth : LookForTruth(request.input);
    if (prepared_.truth && !request.truth) {
      Assume("Truth: " + prepared_.truth->string() + ", which lies beside the input.");
    }
  }

  PreparedRecording Prepare() {
    switch (KindOf(request_.input)) {
      case FileKind::kRosBag:
        FromBag();
        break;
      case FileKind::kCapture:
        FromCapture();
        break;
      case FileKind::kKittiRaw:
        FromKittiRaw();
        break;
      case FileKind::kKittiOdometry:
        FromKittiOdometry();
        break;
      case FileKind::kLogFolder:
        FromLog(request_.input / "log.lcm");
        break;
      case FileKind::kLcmLog:
        FromLog(request_.input);
        break;
      default:
        Refuse();
    }
    if (request_.needs_rig && prepared_.rig_files.empty()) {
      WriteRigDraft(request_, known_, prepared_);
      prepared_.is_mounting_assumed = !known_.rig && !known_.T_imu_lidar;
    }
    return std::move(prepared_);
  }

 private:
  void Assume(const std::string& sentence) { prepared_.assumptions.push_back(sentence); }
  std::optional<fs::path> LookForTruth(const fs::path& input) const {
    return request_.needs_truth ? TruthBeside(input) : std::nullopt;
  }
  fs::path OwnTruthFile() const { return request_.out / "truth.tum"; }

  [[noreturn]] void Refuse() const {
    const fs::path& input = request_.input;
    if (!fs::exists(input)) throw InputError(input.string() + ": no such file or folder");
    throw InputError(input.string() +
                     ": is no ROS bag, network capture, KITTI drive or sequence, LCM log or folder "
                     "of lio-sim");
  }

  void FromBag();
  RosbagReport ConvertBag(const RosbagOptions& options);
  void LearnMounting(const TopicChoice& topics);
  void FromCapture();
  void FromKittiRaw();
  void FromKittiOdometry();
  void FromLog(const fs::path& log);

  const RecordingRequest& request_;
  PreparedRecording prepared_;
  SourceKnowledge known_;
};

// A bag may have no truth, or several topics of which nobody named one: it is converted then
// without.
RosbagReport Preparation::ConvertBag(const RosbagOptions& options) {
  if (prepared_.truth || !request_.needs_truth) return ConvertRosbag(options);
  RosbagOptions with_truth = options;
  with_truth.truth_file = OwnTruthFile();
  try {
    RosbagReport report = ConvertRosbag(with_truth);
    if (report.truth && report.truth->num_rows >= kFewestTruthRows) {
      prepared_.truth = OwnTruthFile();
      Assume(fmt::format("Truth: the bag's topic {} ({}).", report.topics.truth.value_or(""),
                         report.truth_description));
    }
    prepared_.report = FormatReport(report, with_truth);
    return report;
  } catch (const std::runtime_error& error) {
    if (request_.truth_topic) throw;
    const bool is_ambiguous = std::string_view(error.what()).starts_with("several truth topics");
    if (is_ambiguous) Assume(fmt::format("No truth is taken from the bag: {}.", error.what()));
  }
  return ConvertRosbag(options);
}

void Preparation::FromBag() {
  prepared_.kind = "ROS bag";
  RosbagOptions options;
  options.input = request_.input;
  options.output = prepared_.log;
  options.lidar_topic = request_.lidar_topic;
  options.imu_topic = request_.imu_topic;
  options.truth_topic = request_.truth_topic;
  options.progress = request_.progress;
  const RosbagReport report = ConvertBag(options);
  prepared_.is_damaged = report.IsDamaged();
  if (prepared_.report.empty()) prepared_.report = FormatReport(report, options);
  Assume(fmt::format("Lidar {}, IMU {}; point time: {}; stamps: {}.", report.topics.lidar,
                     report.topics.imu.value_or("none"), report.rules.point_time_text,
                     report.rules.stamp_text));
  for (const std::string& note : report.notes) Assume(note + ".");
  known_.lidar_name = report.topics.lidar;
  if (report.topics.imu) known_.imu_name = *report.topics.imu;
  if (request_.needs_rig) LearnMounting(report.topics);
}

void Preparation::LearnMounting(const TopicChoice& topics) {
  if (!topics.imu) return;
  const MountedSensors mounted = FindMounting(request_.input, topics.lidar, *topics.imu);
  known_.T_imu_lidar = mounted.T_imu_lidar;
  const bool is_one_frame = mounted.lidar_frame == mounted.imu_frame;
  if (mounted.T_imu_lidar && !is_one_frame) {
    known_.extrinsic_reason = fmt::format("from /tf_static: {} in {}.",
                                          Excerpt(mounted.lidar_frame), Excerpt(mounted.imu_frame));
    return;
  }
  const char* why = is_one_frame                    ? "both sensors name one frame"
                    : mounted.has_static_transforms ? "/tf_static does not connect the two frames"
                                                    : "the bag has no /tf_static";
  known_.T_imu_lidar.reset();
  known_.extrinsic_reason = fmt::format(
      "none (identity) is ASSUMED, since {}: measure it, the verdict tells when it is wrong.", why);
}

void Preparation::FromCapture() {
  prepared_.kind = "network capture";
  PcapOptions options;
  options.input = request_.input;
  options.output = prepared_.log;
  options.sensor = request_.lidar_topic;
  options.imu = request_.imu_file;
  options.progress = request_.progress;
  const PcapReport report = ConvertPcap(options);
  prepared_.is_damaged = report.IsDamaged();
  prepared_.report = FormatReport(report, options);
  Assume(fmt::format("Lidar {} at {}, IMU: {}; the stamps' clock is {}.", report.model,
                     report.sensor, report.imu_text.empty() ? "none" : report.imu_text,
                     report.clock_text));
  known_.lidar_name = report.sensor;
  known_.imu_name = report.imu_text;
  known_.T_imu_lidar = report.T_imu_lidar;
  known_.extrinsic_reason =
      report.T_imu_lidar
          ? "from the sensor's own description, the .json file."
          : "none (identity) is ASSUMED, since captures do not hold it: measure it, the verdict "
            "tells when it is wrong.";
}

void Preparation::FromKittiRaw() {
  prepared_.kind = "KITTI raw drive";
  KittiRawOptions options;
  options.drive = request_.input;
  options.output = prepared_.log;
  options.truth_file = OwnTruthFile();
  options.imu_rate_hz = 100.0;
  options.progress = request_.progress;
  const fs::path drive = WholePath(request_.input);
  const bool has_calibration = fs::exists(drive / "calib_imu_to_velo.txt") ||
                               fs::exists(drive.parent_path() / "calib_imu_to_velo.txt");
  const fs::path day_rig = request_.out / "kitti_rig.yaml";
  if (has_calibration) options.rig_file = day_rig;
  const KittiRawReport report = ConvertKittiRaw(options);
  prepared_.is_damaged = report.IsDamaged();
  prepared_.report = FormatReport(report, options);
  if (!prepared_.truth && request_.needs_truth) {
    prepared_.truth = OwnTruthFile();
    Assume("Truth: the drive's OXTS positions, which are good to a metre.");
  }
  Assume("The IMU's 10 Hz packets are interpolated to 100 Hz.");
  std::vector<fs::path> files = {ConfigDirectory() / "kitti_raw.yaml"};
  if (has_calibration) files.push_back(day_rig);
  known_.rig = RigFrom(files);
  known_.rig_reason = has_calibration
                          ? "KITTI's car; the extrinsic is of the day's calib_imu_to_velo.txt."
                          : "KITTI's car; calib_imu_to_velo.txt is missing, the extrinsic is that "
                            "of 2011_09_26.";
  std::error_code ignored;
  fs::remove(day_rig, ignored);
}

void Preparation::FromKittiOdometry() {
  prepared_.kind = "KITTI odometry sequence";
  KittiOdometryOptions options;
  options.sequence = request_.input;
  options.output = prepared_.log;
  options.progress = request_.progress;
  const fs::path poses = UsualPoses(request_.input);
  if (fs::is_regular_file(poses)) {
    options.poses_file = poses;
    options.truth_file = OwnTruthFile();
  }
  const KittiOdometryReport report = ConvertKittiOdometry(options);
  prepared_.is_damaged = report.IsDamaged();
  prepared_.report = FormatReport(report, options);
  if (options.truth_file && !prepared_.truth) prepared_.truth = OwnTruthFile();
  known_.rig = RigFrom({ConfigDirectory() / "kitti_odometry.yaml"});
  known_.rig_reason = "KITTI's lidar; the sequences have no IMU.";
  known_.never_uses_imu = true;
}

void Preparation::FromLog(const fs::path& log) {
  prepared_.kind = "LCM log";
  prepared_.log = log;
  if (!prepared_.truth) prepared_.truth = LookForTruth(log);
  known_.extrinsic_reason =
      "none (identity) is ASSUMED, since logs do not hold it: measure it, the verdict tells when "
      "it is wrong.";
  const fs::path config = log.parent_path() / "config.yaml";
  if (!request_.needs_rig || !fs::is_regular_file(config)) return;
  prepared_.rig_files = {config};
  Assume("The rig: " + config.string() + ", which lies beside the log.");
}

}  // namespace

PreparedRecording PrepareRecording(const RecordingRequest& request) {
  return Preparation(request).Prepare();
}

}  // namespace lio
