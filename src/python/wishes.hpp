// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes the options of a call out of a dictionary, each by its name.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>

namespace lio::python {

class Wishes {
 public:
  // Messages name the call by `call`.
  Wishes(const pybind11::dict& given, std::string call) : left_(given), call_(std::move(call)) {}

  // Each takes the option out; nothing where it is not given or None. A value of another type is a
  // TypeError, a number outside the limits a UsageError.
  [[nodiscard]] std::optional<std::string> Text(const char* name);
  [[nodiscard]] std::optional<std::filesystem::path> Path(const char* name);
  [[nodiscard]] std::optional<double> Number(const char* name, double least, double most);
  [[nodiscard]] bool Flag(const char* name);

  // Throws UsageError when an option is left that nobody took.
  void DemandAllTaken() const;

 private:
  template <typename Value>
  [[nodiscard]] std::optional<Value> Take(const char* name, const char* wanted);

  pybind11::dict left_;
  std::string call_;
};

}  // namespace lio::python
