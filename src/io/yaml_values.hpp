// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One YAML value into one option field, strictly: what is not exactly of the field's type is
// refused with words. Each ParseValue returns what is wrong, and leaves the value alone then; empty
// when the value was taken. Ranges are not its business.
#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "lio/pipeline/options_fields.hpp"

namespace lio {

// What the node holds, for messages.
std::string Describe(const YAML::Node& node);

std::string ParseValue(const YAML::Node& node, double& value);
std::string ParseValue(const YAML::Node& node, int& value);
std::string ParseValue(const YAML::Node& node, bool& value);
std::string ParseValue(const YAML::Node& node, std::string& value);
std::string ParseValue(const YAML::Node& node, Vector3& value);
// Normalised when the norm is off by no more than rounding to a few digits.
std::string ParseValue(const YAML::Node& node, Quaternion& value);

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
