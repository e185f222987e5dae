// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_raw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "convert/ordered_log.hpp"
#include "convert/sweep_to_chunks.hpp"
#include "lio/base/median.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/stream_stats.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

// Returns the drive itself, or the only drive in a folder of a day.
fs::path FindDrive(const fs::path& given) {
  if (!fs::is_directory(given)) throw InputError(given.string() + ": no such folder");
  const auto is_drive = [](const fs::path& folder) {
    return fs::is_directory(folder / "velodyne_points") && fs::is_directory(folder / "oxts");
  };
  if (is_drive(given)) return given;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(given)) {
    if (is_drive(entry.path())) found.push_back(entry.path());
  }
  if (found.size() == 1) return found.front();
  throw InputError(given.string() + ": no KITTI raw drive: it has no velodyne_points/ and oxts/" +
                   (found.empty() ? "" : ", but holds several drives: name one of them"));
}

// Holds the files of data/ with the stamps of the same numbers.
struct Stamped {
  std::vector<Timestamp> stamps;
  std::map<int, fs::path> files;

  explicit Stamped(const fs::path& folder)
      : stamps(ReadKittiStamps(folder / "timestamps.txt")), files(NumberedFiles(folder / "data")) {
    if (files.empty()) throw InputError((folder / "data").string() + ": no numbered data files");
    std::erase_if(files,
                  [&](const auto& file) { return file.first >= static_cast<int>(stamps.size()); });
  }
  std::int64_t num_missing() const {
    return static_cast<std::int64_t>(stamps.size()) - static_cast<std::int64_t>(files.size());
  }
};

std::vector<OxtsRow> ReadOxts(const fs::path& folder, KittiRawReport& report) {
  const Stamped packets(folder);
  report.num_oxts_missing = packets.num_missing();
  std::vector<OxtsRow> rows;
  for (const auto& [number, file] : packets.files) {
    RefuseIrregular(file);
    std::ifstream stream(file);
    std::string text;
    std::getline(stream, text);
    auto row = ParseOxts(text);
    if (!row) {
      ++report.num_oxts_damaged;
      continue;
    }
    row->stamp = packets.stamps[static_cast<std::size_t>(number)];
    if (!rows.empty() && row->stamp <= rows.back().stamp) {
      ++report.num_oxts_not_later;
      continue;
    }
    rows.push_back(*row);
  }
  if (rows.empty()) throw InputError(folder.string() + ": no OXTS packet can be read");
  return rows;
}

// Returns the duration of each sweep: from the stamps of its start and end if the release has them,
// else the usual interval between sweeps.
std::vector<Duration> Turns(const fs::path& folder, const std::vector<Timestamp>& middles) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < middles.size(); ++i) {
    periods.push_back(SecondsBetween(middles[i - 1], middles[i]));
  }
  constexpr double kNominalSeconds = 0.1033;  // the HDL-64E of KITTI's car
  const double usual = periods.empty() ? kNominalSeconds : UpperMedian(periods);
  std::vector<Duration> turns(middles.size(), Duration::FromSeconds(usual));
  const fs::path starts_file = folder / "timestamps_start.txt";
  const fs::path ends_file = folder / "timestamps_end.txt";
  if (!fs::exists(starts_file) || !fs::exists(ends_file)) return turns;
  const auto starts = ReadKittiStamps(starts_file);
  const auto ends = ReadKittiStamps(ends_file);
  for (std::size_t i = 0; i < std::min({turns.size(), starts.size(), ends.size()}); ++i) {
    const Duration turn = ends[i] - starts[i];
    const bool is_sane = turn.Seconds() > 0.5 * usual && turn.Seconds() < 1.5 * usual;
    if (is_sane) turns[i] = turn;
  }
  return turns;
}

class RawConversion {
 public:
  RawConversion(const KittiRawOptions& options, KittiRawReport& report)
      : options_(options), report_(report), log_(options.output) {}

  void Run();

 private:
  void AddImuUpTo(Timestamp stamp);
  void AddScan(std::vector<LidarPoint> points, Timestamp middle, Duration turn);

  const KittiRawOptions& options_;
  KittiRawReport& report_;
  OrderedLog log_;
  std::vector<ImuSample> imu_;
  std::size_t next_imu_ = 0;
  std::int32_t scan_seq_ = 0;
};

void RawConversion::Run() {
  const fs::path& drive = report_.drive;
  const std::vector<OxtsRow> rows = ReadOxts(drive / "oxts", report_);
  imu_ = OxtsImu(rows, options_.imu_rate_hz);
  const Stamped scans(drive / "velodyne_points");
  const std::vector<Duration> turns = Turns(drive / "velodyne_points", scans.stamps);
  report_.num_scans_missing = scans.num_missing();
  for (const auto& [number, file] : scans.files) {
    if (options_.progress) {
      options_.progress(static_cast<double>(number) / static_cast<double>(scans.stamps.size()));
    }
    auto points = ReadKittiScan(file);
    const auto index = static_cast<std::size_t>(number);
    if (points) {
      AddScan(std::move(*points), scans.stamps[index], turns[index]);
    } else {
      ++report_.num_scans_damaged;
    }
  }
  AddImuUpTo(imu_.back().stamp);
  log_.Close();
  if (report_.lidar.num() == 0) {
    throw InputError(drive.string() + ": not one scan can be read");
  }
  if (!options_.truth_file) return;
  const StampedPoses poses = OxtsPoses(rows);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    report_.truth_length_m += (poses[i].pose.translation - poses[i - 1].pose.translation).norm();
  }
  report_.num_truth_rows = static_cast<std::int64_t>(poses.size());
  WriteTum(*options_.truth_file, poses);
}

void RawConversion::AddImuUpTo(Timestamp stamp) {
  for (; next_imu_ < imu_.size() && imu_[next_imu_].stamp <= stamp; ++next_imu_) {
    const ImuSample& sample = imu_[next_imu_];
    report_.imu.Add(sample.stamp, sample.stamp);
    report_.accelerometer.Add(sample);
    log_.Add(sample.stamp, kImuChannel, EncodeImu(sample, static_cast<std::int32_t>(next_imu_)));
  }
}

void RawConversion::AddScan(std::vector<LidarPoint> points, Timestamp middle, Duration turn) {
  std::vector<std::int64_t> instants(points.size());
  std::transform(points.begin(), points.end(), instants.begin(),
                 [&](const LidarPoint& point) { return KittiPointInstant(point, middle, turn); });
  const TimedSweep sweep = SortSweep(std::move(points), instants);
  report_.lidar.Add(middle, sweep.last);
  report_.num_points += static_cast<std::int64_t>(sweep.points.size());
  AddImuUpTo(sweep.last);
  for (const SentChunk& sent : SplitSweep(sweep, scan_seq_, sweep.last)) {
    log_.Add(sent.sent, kScanChannel, EncodeChunk(sent.chunk));
  }
  ++scan_seq_;
}

// The calibration is one folder up.
fs::path CalibrationOfDay(const fs::path& drive) {
  return WholePath(drive).parent_path() / "calib_imu_to_velo.txt";
}

void WriteRig(const fs::path& drive, const fs::path& file) {
  const fs::path source = CalibrationOfDay(drive);
  const fs::path calibration = fs::exists(source) ? source : drive / "calib_imu_to_velo.txt";
  if (!fs::exists(calibration)) {
    throw InputError(source.string() + ": does not exist, but --rig needs it");
  }
  auto rows = ReadKittiCalibration(calibration);
  const Pose T_lidar_imu = ToPose(rows["R"], rows["T"], calibration.string());
  const Pose T_imu_lidar = T_lidar_imu.Inverse();
  const Vector3& t = T_imu_lidar.translation;
  const Quaternion& q = T_imu_lidar.rotation;
  const std::string text = fmt::format(
      "# From {}: p_imu = T_imu_lidar * p_lidar.\n"
      "rig:\n"
      "  T_imu_lidar:\n"
      "    translation_m: [{:.9f}, {:.9f}, {:.9f}]\n"
      "    rotation_wxyz: [{:.12f}, {:.12f}, {:.12f}, {:.12f}]\n"
      "  lidar:\n"
      "    model: hdl64e\n",
      calibration.filename().string(), t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
  WriteText(file, text, OutputFile::Links::kFollowed);
}

}  // namespace

std::int64_t KittiPointInstant(const LidarPoint& point, Timestamp middle, Duration turn) {
  const double azimuth = std::atan2(double{point.y_m}, double{point.x_m});
  return (middle - Duration::FromSeconds(azimuth / (2.0 * std::numbers::pi) * turn.Seconds())).ns;
}

std::vector<fs::path> InputsOf(const KittiRawOptions& options) {
  return {options.drive, CalibrationOfDay(options.drive)};
}

KittiRawReport ConvertKittiRaw(const KittiRawOptions& options) {
  KittiRawReport report;
  report.drive = FindDrive(options.drive);
  if (options.rig_file) WriteRig(report.drive, *options.rig_file);
  RawConversion(options, report).Run();
  return report;
}

// The synchronised release has 10 Hz. Chosen: between that and the slowest units.
constexpr double kUsefulImuRate_hz = 20.0;

std::string FormatReport(const KittiRawReport& report, const KittiRawOptions& options) {
  std::string text;
  const auto add = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<13}{}\n", name, value);
  };
  const auto span = [](const StreamStats& s) {
    return fmt::format("stamps {} to {} ({:.3f} s), longest period {:.1f} ms, {} gaps",
                       StampText(*s.first_stamp()), StampText(*s.last_stamp()), s.span_s(),
                       1e3 * s.longest_gap_s(), s.num_gaps());
  };
  add("input", report.drive.string());
  add("lidar",
      fmt::format(
          "{} sweeps at {:.3f} Hz, {:.0f} points each", report.lidar.num(), report.lidar.rate_hz(),
          static_cast<double>(report.num_points) / static_cast<double>(report.lidar.num())));
  add("", span(report.lidar));
  add("point time", "from azimuth: one clockwise turn, facing forward at the stamp");
  add("ring", "from the order of the points, counted from below");
  add("imu", fmt::format("{} samples at {:.2f} Hz{}", report.imu.num(), report.imu.rate_hz(),
                         options.imu_rate_hz ? ", interpolated linearly" : ""));
  if (report.imu.num() > 0) add("", span(report.imu));
  if (!options.imu_rate_hz && report.imu.rate_hz() < kUsefulImuRate_hz) {
    add("",
        "too slow to tell the motion between: --imu-rate 100 interpolates, or run by the lidar "
        "alone, with pipeline.use_imu: false");
  }
  add("", fmt::format("mean |accel| {:.3f}, in the quietest second {:.3f}: {}",
                      report.accelerometer.mean_mps2(), report.accelerometer.quiet_mean_mps2(),
                      report.accelerometer.Suggestion()));
  if (report.num_oxts_not_later > 0) {
    add("", fmt::format("{} packets left out: stamps not increasing", report.num_oxts_not_later));
  }
  if (options.truth_file) {
    add("truth",
        fmt::format("{} rows, {:.1f} m, to {}: pose of the IMU in east-north-up",
                    report.num_truth_rows, report.truth_length_m, options.truth_file->string()));
  }
  if (options.rig_file) add("rig", options.rig_file->string());
  if (report.IsDamaged()) {
    add("damaged", fmt::format("{} scans missing, {} unreadable; {} OXTS packets missing, {} "
                               "unreadable",
                               report.num_scans_missing, report.num_scans_damaged,
                               report.num_oxts_missing, report.num_oxts_damaged));
  }
  add("output", options.output.string());
  return text;
}

}  // namespace lio
