// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/arrays.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lio/base/stamp_limit.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

std::string ShapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

// Returns the numbers as they are; `kinds` are NumPy's letters for the kinds of numbers allowed.
py::array TakeArray(const py::object& given, const char* what, std::string_view kinds,
                    const char* wanted) {
  py::array array = py::array::ensure(given);
  if (!array) throw py::type_error(fmt::format("{}: expects {}, not this", what, wanted));
  if (kinds.find(array.dtype().kind()) == std::string_view::npos) {
    throw py::type_error(fmt::format("{}: expects {}, not an array of {}", what, wanted,
                                     std::string(py::str(array.dtype()))));
  }
  return array;
}

}  // namespace

Rows TakeRows(const py::object& given, const char* what, py::ssize_t columns) {
  const py::array array = TakeArray(given, what, "fiu", "real numbers");
  Rows rows;
  rows.is_single = array.ndim() == 1;
  const bool fits =
      (array.ndim() == 1 || array.ndim() == 2) && array.shape(array.ndim() - 1) == columns;
  if (!fits) {
    throw py::value_error(fmt::format("{}: expects the shape ({},) or (N, {}), not {}", what,
                                      columns, columns, ShapeText(array)));
  }
  rows.num_rows = rows.is_single ? 1 : array.shape(0);
  rows.values = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  return rows;
}

Integers TakeIntegers(const py::object& given, const char* what, std::int64_t least,
                      std::int64_t most) {
  const py::array array = TakeArray(given, what, "iu", "integers");
  if (array.ndim() > 1) {
    throw py::value_error(
        fmt::format("{}: expects one integer or the shape (N,), not {}", what, ShapeText(array)));
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> values(array);
  Integers integers;
  integers.is_single = array.ndim() == 0;
  integers.values.assign(values.data(), values.data() + values.size());
  // Unsigned values beyond the signed ones have become negative, and no least is below zero then.
  const bool is_unsigned = array.dtype().kind() == 'u';
  const auto is_outside = [&](std::int64_t value) {
    return value < (is_unsigned ? std::max<std::int64_t>(least, 0) : least) || value > most;
  };
  if (std::any_of(integers.values.begin(), integers.values.end(), is_outside)) {
    throw py::value_error(fmt::format("{}: expects {} to {}", what, least, most));
  }
  return integers;
}

Integers TakeStamps(const py::object& given, const char* what) {
  return TakeIntegers(given, what, 0, kMaxStamp_ns);
}

py::array_t<double> PoseMatrix(const Pose& pose) {
  py::array_t<double> matrix({4, 4});
  auto entries = matrix.mutable_unchecked<2>();
  const Matrix3 rotation = pose.rotation.toRotationMatrix();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) entries(row, column) = row == column ? 1.0 : 0.0;
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) entries(row, column) = rotation(row, column);
    entries(row, 3) = pose.translation(row);
  }
  return matrix;
}

py::array_t<float> CloudArray(const std::vector<Eigen::Vector3f>& points) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  const auto num_rows = static_cast<py::ssize_t>(points.size());
  const float* first = points.empty() ? nullptr : points.front().data();
  return py::array_t<float>({num_rows, py::ssize_t{3}}, first);
}

}  // namespace lio::python
