// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "yaml_rotations.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <numbers>
#include <vector>

#include "yaml_values.hpp"

namespace lio {
namespace {

// Calibrations are printed with four digits and more; a matrix farther off has a wrong number.
constexpr double kMaxOffRotation = 2e-3;

std::string AppendNumbers(const YAML::Node& list, std::vector<double>& values) {
  for (const YAML::Node& entry : list) {
    double value = 0.0;
    if (const std::string problem = ParseValue(entry, value); !problem.empty()) return problem;
    values.push_back(value);
  }
  return "";
}

// Reads `size` rows of `size` numbers each, or all of them in one list.
std::string ParseSquare(const YAML::Node& node, std::size_t size, std::vector<double>& values) {
  const std::string expected = fmt::format("expects {0} rows of {0} numbers, not ", size);
  if (!node.IsSequence()) return expected + Describe(node);
  const bool is_flat = node.size() == size * size;
  if (!is_flat && node.size() != size) return expected + fmt::format("a list of {}", node.size());
  if (is_flat) return AppendNumbers(node, values);
  for (const YAML::Node& row : node) {
    if (!row.IsSequence()) return expected + "with " + Describe(row);
    if (row.size() != size) return expected + fmt::format("with a row of {}", row.size());
    if (const std::string problem = AppendNumbers(row, values); !problem.empty()) return problem;
  }
  return "";
}

std::string ToRotation(const Matrix3& matrix, Quaternion& rotation) {
  if (!matrix.allFinite()) return "must be finite numbers";
  const double off = (matrix * matrix.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (off > kMaxOffRotation) {
    return fmt::format(
        "is no rotation: its rows must have length 1 and be at right angles, they are off by "
        "{:.2g}",
        off);
  }
  if (matrix.determinant() < 0.0) {
    return "is a mirror image, no rotation: its determinant is -1; one axis has the wrong sign";
  }
  const Eigen::JacobiSVD<Matrix3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  rotation = Quaternion(Matrix3(svd.matrixU() * svd.matrixV().transpose())).normalized();
  return "";
}

}  // namespace

std::string ParseRpyDeg(const YAML::Node& node, Quaternion& rotation) {
  Vector3 rpy_deg;
  if (std::string problem = ParseValue(node, rpy_deg); !problem.empty()) return problem;
  if (!rpy_deg.allFinite()) return "must be finite numbers";
  if (rpy_deg.cwiseAbs().maxCoeff() > 360.0) return "expects degrees within -360 .. 360";
  const Vector3 rpy_rad = rpy_deg * std::numbers::pi / 180.0;
  rotation = Eigen::AngleAxisd(rpy_rad.z(), Vector3::UnitZ()) *
             Eigen::AngleAxisd(rpy_rad.y(), Vector3::UnitY()) *
             Eigen::AngleAxisd(rpy_rad.x(), Vector3::UnitX());
  rotation.normalize();
  return "";
}

std::string ParseRotationMatrix(const YAML::Node& node, Quaternion& rotation) {
  std::vector<double> values;
  if (std::string problem = ParseSquare(node, 3, values); !problem.empty()) return problem;
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return ToRotation(Eigen::Map<const RowMajor>(values.data()), rotation);
}

std::string ParseTransformMatrix(const YAML::Node& node, Pose& pose) {
  std::vector<double> values;
  if (std::string problem = ParseSquare(node, 4, values); !problem.empty()) return problem;
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> matrix(values.data());
  if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    return "its last row must be 0 0 0 1: give it row by row";
  }
  if (!matrix.allFinite()) return "must be finite numbers";
  Quaternion rotation;
  if (std::string problem = ToRotation(matrix.topLeftCorner<3, 3>(), rotation); !problem.empty()) {
    return problem;
  }
  pose = {rotation, matrix.topRightCorner<3, 1>()};
  return "";
}

}  // namespace lio
