// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/foxglove_json.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lio/base/counters_fields.hpp"
#include "lio/io/json_text.hpp"
#include "lio/io/status_report_json.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr int kUint16Type = 3;  // numbers of foxglove.PackedElementField
constexpr int kFloat32Type = 7;
constexpr double kSigmas = 3.0;

Json TimeJson(Timestamp stamp) {
  const std::int64_t ns = std::max<std::int64_t>(0, stamp.ns);
  return {{"sec", ns / kNsPerSecond}, {"nsec", ns % kNsPerSecond}};
}

Json VectorJson(const Vector3& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

Json RotationJson(const Quaternion& q) {
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Json PlacedJson(const Pose& pose) {
  return {{"position", VectorJson(pose.translation)}, {"orientation", RotationJson(pose.rotation)}};
}

template <typename Matrix>
Json RowsJson(const Matrix& matrix) {
  Json values = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      values.push_back(matrix(row, column));
    }
  }
  return values;
}

// Returns x, y, z as floats, then intensity and ring, little-endian.
std::string PackedPoints(const std::vector<LidarPoint>& points) {
  std::string data;
  data.reserve(points.size() * 16);
  const auto append = [&data](const auto& value) {
    data.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const LidarPoint& p : points) {
    if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m) || !std::isfinite(p.z_m)) continue;
    append(p.x_m);
    append(p.y_m);
    append(p.z_m);
    append(p.intensity);
    append(p.ring);
  }
  return data;
}

}  // namespace

std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t num = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      bits = bits << 8 | (j < num ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= num ? kDigits[(bits >> (18 - 6 * j)) & 63U] : '=';
    }
  }
  return text;
}

std::string PointCloudJson(const ScanChunk& chunk, const char* frame) {
  const auto field = [](const char* name, int offset, int type) {
    return Json{{"name", name}, {"offset", offset}, {"type", type}};
  };
  return TextOf(
      {{"timestamp", TimeJson(chunk.stamp)},
       {"frame_id", frame},
       {"pose", PlacedJson(Pose::Identity())},
       {"point_stride", 16},
       {"fields",
        {field("x", 0, kFloat32Type), field("y", 4, kFloat32Type), field("z", 8, kFloat32Type),
         field("intensity", 12, kUint16Type), field("ring", 14, kUint16Type)}},
       {"data", Base64(PackedPoints(chunk.points))}});
}

std::string PoseJson(Timestamp stamp, const char* frame, const Pose& pose) {
  return TextOf({{"timestamp", TimeJson(stamp)}, {"frame_id", frame}, {"pose", PlacedJson(pose)}});
}

std::string PosesJson(Timestamp stamp, const char* frame, std::span<const Pose> poses) {
  Json all = Json::array();
  for (const Pose& pose : poses) all.push_back(PlacedJson(pose));
  return TextOf({{"timestamp", TimeJson(stamp)}, {"frame_id", frame}, {"poses", std::move(all)}});
}

std::string TransformJson(Timestamp stamp, const char* parent, const char* child,
                          const Pose& T_parent_child) {
  return TextOf({{"timestamp", TimeJson(stamp)},
                 {"parent_frame_id", parent},
                 {"child_frame_id", child},
                 {"translation", VectorJson(T_parent_child.translation)},
                 {"rotation", RotationJson(T_parent_child.rotation)}});
}

std::string EllipsoidJson(const NavOutput& nav) {
  const Matrix3 cov = nav.pose_cov.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(0.5 * (cov + cov.transpose()));
  Matrix3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  const Vector3 diameters = 2.0 * kSigmas * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Pose pose{Quaternion(axes).normalized(), nav.T_world_imu.translation};
  const Json sphere = {{"pose", PlacedJson(pose)},
                       {"size", VectorJson(diameters)},
                       {"color", {{"r", 0.78}, {"g", 0.49}, {"b", 1.0}, {"a", 0.4}}}};
  Json entity = {{"timestamp", TimeJson(nav.stamp)},
                 {"frame_id", kWorldFrame},
                 {"id", "three sigma of the position"},
                 {"lifetime", {{"sec", 0}, {"nsec", 0}}},  // until the next one
                 {"frame_locked", false},
                 {"metadata", Json::array()},
                 {"spheres", Json::array({sphere})}};
  for (const char* kind :
       {"arrows", "cubes", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[kind] = Json::array();
  }
  return TextOf({{"deletions", Json::array()}, {"entities", Json::array({entity})}});
}

std::string LogJson(Timestamp stamp, Trust trust, std::string_view text) {
  constexpr std::array kLevels = {2, 3, 4};  // info, warning, error
  return TextOf({{"timestamp", TimeJson(stamp)},
                 {"level", kLevels[static_cast<std::size_t>(trust)]},
                 {"message", text},
                 {"name", "liod"},
                 {"file", ""},
                 {"line", 0}});
}

std::string OdometryPlotJson(const NavOutput& nav) {
  const Vector6 variances = nav.pose_cov.diagonal();
  const Vector6 std = variances.cwiseMax(0.0).cwiseSqrt();
  return TextOf({{"timestamp", TimeJson(nav.stamp)},
                 {"status", static_cast<int>(nav.status)},
                 {"scan_seq", nav.scan_seq},
                 {"velocity_world_mps", VectorJson(nav.v_world_imu_mps)},
                 {"rate_imu_radps", VectorJson(nav.w_imu_radps)},
                 {"speed_mps", nav.v_world_imu_mps.norm()},
                 {"position_std_m", VectorJson(std.head<3>())},
                 {"rotation_std_rad", VectorJson(std.tail<3>())},
                 {"pose_cov", RowsJson(nav.pose_cov)},
                 {"velocity_cov", RowsJson(nav.velocity_cov)}});
}

std::string StatePlotJson(const FilterReport& report) {
  return TextOf({{"timestamp", TimeJson(report.nav.stamp)},
                 {"velocity_world_mps", VectorJson(report.nav.v_world_imu_mps)},
                 {"gyro_bias_radps", VectorJson(report.gyro_bias_radps)},
                 {"accel_bias_mps2", VectorJson(report.accel_bias_mps2)},
                 {"gravity_world_mps2", VectorJson(report.g_world_mps2)},
                 {"clock_offset_s", report.clock_offset_s},
                 {"clock_offset_std_s", report.clock_offset_std_s},
                 {"nis", report.nis},
                 {"nis_dof", report.nis_dof}});
}

std::string MatchPlotJson(const ScanReport& report) {
  constexpr std::array kStages = {"decode", "reduce", "deskew", "match",
                                  "insert", "filter", "total"};
  static_assert(kStages.size() == kNumStages);
  Json stages;
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    stages[kStages[i]] = 1e-6 * static_cast<double>(report.stage_ns[i]);
  }
  return TextOf({{"timestamp", TimeJson(report.stamp)},
                 {"status", static_cast<int>(report.status)},
                 {"fused", report.fused},
                 {"num_raw", report.num_raw},
                 {"num_used", report.num_used},
                 {"num_matched", report.num_matched},
                 {"iterations", report.iterations},
                 {"rms_m", report.residual_rms_m},
                 {"nis", report.nis},
                 {"degenerate_mask", report.degenerate_mask},
                 {"stage_ms", std::move(stages)}});
}

std::string StatusPlotJson(const StatusReport& report) {
  Json counts;
  for (const CounterField& field : kCounterFields) {
    counts[std::string(field.name)] = report.counters.*field.count;
  }
  Json json = {{"timestamp", TimeJson(report.newest_stamp)}};
  json.update(StatusReportJson(report));
  json["kernel_dropped"] = report.num_kernel_dropped;
  json["counts"] = std::move(counts);
  return TextOf(json);
}

std::string ImuPlotJson(const ImuSample& sample) {
  return TextOf({{"timestamp", TimeJson(sample.stamp)},
                 {"gyro_radps", VectorJson(sample.w_imu_radps)},
                 {"accel_mps2", VectorJson(sample.f_imu_mps2)}});
}

}  // namespace lio
