// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/path_arrays.hpp"

#include <fmt/format.h>

#include "python/arrays.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

constexpr double kRotationTolerance = 1e-3;  // rounding is far below, anything else is no rotation
constexpr py::ssize_t kPoseNumbers = 16;

// Reads a row-major matrix of 4 x 4.
Pose TakePose(const double* numbers, const char* what, std::size_t row) {
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers);
  const Matrix3 rotation = matrix.topLeftCorner<3, 3>();
  const bool is_pose = matrix.allFinite() && rotation.determinant() > 0.0 &&
                       (rotation * rotation.transpose()).isIdentity(kRotationTolerance) &&
                       (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() < kRotationTolerance;
  if (!is_pose) throw py::value_error(fmt::format("{}: pose {} is no rigid motion", what, row));
  return {Quaternion(rotation).normalized(), matrix.topRightCorner<3, 1>()};
}

}  // namespace

Trajectory TakeTrajectory(const py::tuple& given, const char* what) {
  if (given.size() != 2) {
    throw py::value_error(fmt::format("{}: expects two arrays, stamps and poses", what));
  }
  const py::object stamps_given = given[0];
  const Integers stamps = TakeStamps(stamps_given, what);
  const py::array poses = py::array::ensure(py::object(given[1]));
  if (!poses || poses.ndim() != 3 || poses.shape(1) != 4 || poses.shape(2) != 4 ||
      poses.shape(0) != static_cast<py::ssize_t>(stamps.values.size())) {
    throw py::value_error(
        fmt::format("{}: expects poses of the shape ({}, 4, 4)", what, stamps.values.size()));
  }
  const Rows rows = TakeRows(poses.attr("reshape")(-1, kPoseNumbers), what, kPoseNumbers);
  Trajectory trajectory;
  for (std::size_t i = 0; i < stamps.values.size(); ++i) {
    const Timestamp stamp{stamps.values[i]};
    if (i > 0 && stamp <= trajectory.poses.back().stamp) {
      throw py::value_error(fmt::format("{}: stamp {} is not above the one before", what, i));
    }
    trajectory.poses.push_back({stamp, TakePose(rows.values.data() + kPoseNumbers * i, what, i)});
  }
  return trajectory;
}

}  // namespace lio::python
