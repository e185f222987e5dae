// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "export/foxglove_json.hpp"
#include "export/foxglove_schemas.hpp"
#include "export/mcap_file.hpp"
#include "export/output_reader.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxPathPoses = 1000;  // in one message; longer paths are thinned evenly
constexpr std::size_t kMinNewPoses = 10;

// The path grows, and each message has all of it: it is told when it is a twentieth longer, so that
// an hour takes some hundred messages.
class GrowingPath {
 public:
  void Add(const Pose& pose) { poses_.push_back(pose); }
  [[nodiscard]] bool IsDue() const {
    return poses_.size() >= num_told_ + std::max(kMinNewPoses, num_told_ / 20);
  }
  [[nodiscard]] bool HasUntold() const { return poses_.size() > num_told_; }
  std::vector<Pose> Tell() {
    num_told_ = poses_.size();
    const std::size_t stride = poses_.size() / kMaxPathPoses + 1;
    std::vector<Pose> thinned;
    for (std::size_t i = 0; i < poses_.size(); i += stride) thinned.push_back(poses_[i]);
    if ((poses_.size() - 1) % stride != 0) thinned.push_back(poses_.back());
    return thinned;
  }

 private:
  std::vector<Pose> poses_;
  std::size_t num_told_ = 0;
};

class McapExport {
 public:
  McapExport(const std::filesystem::path& path, McapCompression compression)
      : file_(path, compression) {}

  OutputTakers Takers(bool with_inputs) {
    OutputTakers takers;
    takers.odometry = [this](const NavOutput& nav, Timestamp at) { AddOdometry(nav, at); };
    takers.odometry_imu = [this](const NavOutput& nav, Timestamp at) {
      Put(odometry_imu_, at, nav.stamp, OdometryPlotJson(nav));
    };
    takers.state = [this](const FilterReport& report, Timestamp at) {
      Put(state_, at, report.nav.stamp, StatePlotJson(report));
    };
    takers.registration = [this](const ScanReport& report, Timestamp at) {
      Put(match_, at, report.stamp, MatchPlotJson(report));
    };
    takers.status = [this](const StatusReport& report, Timestamp at) { AddStatus(report, at); };
    takers.cloud = [this](const ScanChunk& chunk, Timestamp at) {
      Put(cloud_, at, chunk.stamp, PointCloudJson(chunk, kMapFrame));
    };
    if (!with_inputs) return takers;
    takers.imu = [this](const ImuSample& sample, Timestamp at) {
      Put(imu_, at, sample.stamp, ImuPlotJson(sample));
    };
    takers.scan = [this](const ScanChunk& chunk, Timestamp at) {
      Put(scan_, at, chunk.stamp, PointCloudJson(chunk, kLidarFrame));
    };
    return takers;
  }

  void Close() {
    if (path_poses_.HasUntold()) TellPath();
    file_.Close();
  }

 private:
  void Put(std::uint16_t topic, Timestamp received, Timestamp stamp, const std::string& json) {
    file_.Write(topic, received, stamp, json);
  }

  void AddOdometry(const NavOutput& nav, Timestamp at) {
    const Pose T_world_map = nav.T_world_imu * nav.T_map_imu.Inverse();
    Put(transforms_, at, nav.stamp, TransformJson(nav.stamp, kWorldFrame, kMapFrame, T_world_map));
    Put(transforms_, at, nav.stamp, TransformJson(nav.stamp, kMapFrame, kImuFrame, nav.T_map_imu));
    Put(pose_, at, nav.stamp, PoseJson(nav.stamp, kWorldFrame, nav.T_world_imu));
    Put(ellipsoid_, at, nav.stamp, EllipsoidJson(nav));
    Put(odometry_, at, nav.stamp, OdometryPlotJson(nav));
    path_poses_.Add(nav.T_world_imu);
    last_received_ = at;
    last_stamp_ = nav.stamp;
    if (path_poses_.IsDue()) TellPath();
  }

  void TellPath() {
    Put(path_, last_received_, last_stamp_,
        PosesJson(last_stamp_, kWorldFrame, path_poses_.Tell()));
  }

  void AddStatus(const StatusReport& report, Timestamp at) {
    Put(status_, at, report.newest_stamp, StatusPlotJson(report));
    if (report.note.empty() || report.note == last_note_) return;
    last_note_ = report.note;
    Put(log_, at, report.newest_stamp, LogJson(report.newest_stamp, report.trust, report.note));
  }

  std::uint16_t Topic(const char* topic, const char* type, const std::string& schema) {
    return file_.AddTopic(topic, type, schema);
  }
  std::uint16_t Plot(const char* topic, const char* type) {
    return Topic(topic, type, PlotSchema(type));
  }

  McapFile file_;
  std::uint16_t transforms_ = Topic("/tf", "foxglove.FrameTransform", FrameTransformSchema());
  std::uint16_t pose_ = Topic("/liod/pose", "foxglove.PoseInFrame", PoseInFrameSchema());
  std::uint16_t path_ = Topic("/liod/path", "foxglove.PosesInFrame", PosesInFrameSchema());
  std::uint16_t ellipsoid_ =
      Topic("/liod/uncertainty", "foxglove.SceneUpdate", SceneUpdateSchema());
  std::uint16_t cloud_ = Topic("/liod/cloud", "foxglove.PointCloud", PointCloudSchema());
  std::uint16_t log_ = Topic("/liod/notices", "foxglove.Log", LogSchema());
  std::uint16_t odometry_ = Plot("/liod/odometry", "lio.Odometry");
  std::uint16_t odometry_imu_ = Plot("/liod/odometry_imu", "lio.Odometry");
  std::uint16_t state_ = Plot("/liod/state", "lio.FilterState");
  std::uint16_t match_ = Plot("/liod/match", "lio.Registration");
  std::uint16_t status_ = Plot("/liod/status", "lio.Status");
  std::uint16_t imu_ = Plot("/imu", "lio.Imu");
  std::uint16_t scan_ = Topic("/scan", "foxglove.PointCloud", PointCloudSchema());
  GrowingPath path_poses_;
  Timestamp last_received_;
  Timestamp last_stamp_;
  std::string last_note_;
};

}  // namespace

ExportCounts ExportMcap(const std::filesystem::path& log, const std::filesystem::path& file,
                        const ExportOptions& options) {
  try {
    McapExport out(file, options.compression);
    const ExportCounts counts = ReadOutputs(log, options, out.Takers(options.with_inputs));
    out.Close();
    return counts;
  } catch (const InputError&) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);  // a file without a message helps nobody
    throw;
  }
}

}  // namespace lio
