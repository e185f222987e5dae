// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Arrays of NumPy: checked on the way in, views without a copy on the way out.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio::python {

// Rows that Python gave. A single one has a dimension less.
struct Rows {
  pybind11::array_t<double> values;  // C order
  bool is_single = false;
  pybind11::ssize_t num_rows = 0;
};

// Takes numbers of shape (columns,) or (N, columns), integers or floats of any width. Throws a
// TypeError for anything else than real numbers, and a ValueError for another shape; both name
// `what`.
[[nodiscard]] Rows TakeRows(const pybind11::object& given, const char* what,
                            pybind11::ssize_t columns);

// Takes integers of shape () or (N,) within the limits. Throws likewise.
struct Integers {
  std::vector<std::int64_t> values;
  bool is_single = false;
};
[[nodiscard]] Integers TakeIntegers(const pybind11::object& given, const char* what,
                                    std::int64_t least, std::int64_t most);

// Takes stamps in nanoseconds, as TakeIntegers does. Those that no message could bear are refused:
// differences of stamps must not overflow.
[[nodiscard]] Integers TakeStamps(const pybind11::object& given, const char* what);

// Returns a read-only array on memory that `owner` keeps alive and never moves.
template <typename Number>
pybind11::array View(const pybind11::object& owner, const Number* first,
                     std::vector<pybind11::ssize_t> shape, std::vector<pybind11::ssize_t> strides) {
  pybind11::array view(pybind11::dtype::of<Number>(), std::move(shape), std::move(strides), first,
                       owner);
  view.attr("setflags")(pybind11::arg("write") = false);
  return view;
}

// Returns the view of a vector or a matrix that is a member of `owner`.
template <typename Matrix>
pybind11::array MatrixView(const pybind11::object& owner, const Matrix& matrix) {
  constexpr auto kBytes = static_cast<pybind11::ssize_t>(sizeof(double));
  if constexpr (Matrix::ColsAtCompileTime == 1) {
    return View(owner, matrix.data(), {matrix.rows()}, {kBytes});
  } else {
    return View(owner, matrix.data(), {matrix.rows(), matrix.cols()},
                {kBytes, kBytes * matrix.rows()});  // Eigen has columns one after another
  }
}

// Returns a pose as a matrix of 4 x 4, a copy.
[[nodiscard]] pybind11::array_t<double> PoseMatrix(const Pose& pose);

// Returns a copy with these rows of three numbers.
[[nodiscard]] pybind11::array_t<float> CloudArray(const std::vector<Eigen::Vector3f>& points);

}  // namespace lio::python
