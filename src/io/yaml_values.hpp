// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads one YAML value into one field of the options, strictly: a value that is not exactly of the
// field's type is refused. Each ParseValue returns an empty text when the value was taken,
// otherwise what is wrong with it, and then leaves the field alone. Ranges are checked elsewhere.
#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "lio/pipeline/options_fields.hpp"

namespace lio {

// Describes the contents of the node, for messages.
[[nodiscard]] std::string Describe(const YAML::Node& node);

[[nodiscard]] std::string ParseValue(const YAML::Node& node, double& value);
[[nodiscard]] std::string ParseValue(const YAML::Node& node, int& value);
[[nodiscard]] std::string ParseValue(const YAML::Node& node, bool& value);
[[nodiscard]] std::string ParseValue(const YAML::Node& node, std::string& value);
[[nodiscard]] std::string ParseValue(const YAML::Node& node, Vector3& value);
[[nodiscard]] std::string ParseValue(const YAML::Node& node, std::vector<double>& value);
// The quaternion is normalised when its norm is off by no more than rounding to a few digits.
[[nodiscard]] std::string ParseValue(const YAML::Node& node, Quaternion& value);

template <class Enum>
requires std::is_enum_v<Enum> std::string ParseValue(const YAML::Node& node, Enum& value) {
  const auto& names = kEnumNames<Enum>;
  const auto found =
      node.IsScalar() ? std::find(names.begin(), names.end(), node.Scalar()) : names.end();
  if (found != names.end()) {
    value = static_cast<Enum>(found - names.begin());
    return "";
  }
  std::string choices;
  for (std::string_view name : names) (choices += choices.empty() ? "" : ", ") += name;
  return "expects one of " + choices + ", not " + Describe(node);
}

}  // namespace lio
