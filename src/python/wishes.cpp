// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/wishes.hpp"

#include <fmt/format.h>

#include "lio/io/input_error.hpp"

namespace py = pybind11;

namespace lio::python {

template <typename Value>
std::optional<Value> Wishes::Take(const char* name, const char* wanted) {
  if (!left_.contains(name)) return std::nullopt;
  const py::object value = left_.attr("pop")(name);
  if (value.is_none()) return std::nullopt;
  try {
    return value.cast<Value>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("{}: expects {}", name, wanted));
  }
}

std::optional<std::string> Wishes::Text(const char* name) {
  return Take<std::string>(name, "a text");
}

std::optional<std::filesystem::path> Wishes::Path(const char* name) {
  return Take<std::filesystem::path>(name, "a path");
}

std::optional<double> Wishes::Number(const char* name, double least, double most) {
  const std::optional<double> number = Take<double>(name, "a number");
  if (number && !(*number >= least && *number <= most)) {
    throw UsageError(
        fmt::format("{}: expects a number from {} to {}, not {}", name, least, most, *number));
  }
  return number;
}

bool Wishes::Flag(const char* name) {
  return Take<bool>(name, "True or False").value_or(false);
}

void Wishes::DemandAllTaken() const {
  for (const auto& [name, value] : left_) {
    if (value.is_none()) continue;
    throw UsageError(fmt::format("{}: is no option of {}", std::string(py::str(name)), call_));
  }
}

}  // namespace lio::python
