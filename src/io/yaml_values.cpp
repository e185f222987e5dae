// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "yaml_values.hpp"

#include <charconv>
#include <cmath>

#include "lio/io/printable.hpp"

namespace lio {
namespace {

bool IsUnquoted(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() != "!";  // yaml-cpp marks quoted text with this tag
}

template <class Number>
bool ParseNumber(const YAML::Node& node, Number& value) {
  if (!IsUnquoted(node)) return false;
  std::string_view text = node.Scalar();
  if (text.starts_with('+')) text.remove_prefix(1);
  Number parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = parsed;
  return true;
}

// Parses a list into as many values.
template <class Values>
std::string ParseEntries(const YAML::Node& list, const std::string& expected, Values& values) {
  auto value = values.begin();
  for (const YAML::Node& entry : list) {
    if (!ParseNumber(entry, *value++)) return expected + "one with " + Describe(entry);
  }
  return "";
}

template <int kSize>
std::string ParseNumbers(const YAML::Node& node, Eigen::Matrix<double, kSize, 1>& values) {
  const std::string expected = "expects a list of " + std::to_string(kSize) + " numbers, not ";
  if (!node.IsSequence()) return expected + Describe(node);
  if (node.size() != kSize) return expected + "one of " + std::to_string(node.size());
  Eigen::Matrix<double, kSize, 1> parsed;
  std::string problem = ParseEntries(node, expected, parsed);
  if (problem.empty()) values = parsed;
  return problem;
}

}  // namespace

std::string Describe(const YAML::Node& node) {
  if (node.IsScalar()) {
    const std::string begin = IsUnquoted(node) ? "'" : "quoted '";
    return begin + Excerpt(node.Scalar()) + "'";
  }
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a map" : "nothing";
}

std::string ParseValue(const YAML::Node& node, double& value) {
  return ParseNumber(node, value) ? "" : "expects a number, not " + Describe(node);
}

std::string ParseValue(const YAML::Node& node, int& value) {
  return ParseNumber(node, value) ? "" : "expects a whole number, not " + Describe(node);
}

std::string ParseValue(const YAML::Node& node, bool& value) {
  const bool is_bool = IsUnquoted(node) && (node.Scalar() == "true" || node.Scalar() == "false");
  if (!is_bool) return "expects true or false, not " + Describe(node);
  value = node.Scalar() == "true";
  return "";
}

std::string ParseValue(const YAML::Node& node, std::string& value) {
  if (!node.IsScalar()) return "expects a name, not " + Describe(node);
  value = node.Scalar();
  return "";
}

std::string ParseValue(const YAML::Node& node, Vector3& value) {
  return ParseNumbers<3>(node, value);
}

std::string ParseValue(const YAML::Node& node, std::vector<double>& value) {
  const std::string expected = "expects a list of numbers, not ";
  if (!node.IsSequence()) return expected + Describe(node);
  std::vector<double> parsed(node.size());
  std::string problem = ParseEntries(node, expected, parsed);
  if (problem.empty()) value = std::move(parsed);
  return problem;
}

std::string ParseValue(const YAML::Node& node, Quaternion& value) {
  Eigen::Vector4d wxyz;
  std::string problem = ParseNumbers<4>(node, wxyz);
  if (!problem.empty()) return problem;
  value = Quaternion(wxyz(0), wxyz(1), wxyz(2), wxyz(3));
  // A norm that is farther off is left for Validate to refuse. One that is right to the last bits
  // is left alone, so that printed options load as the same bits.
  const double norm_error = std::abs(value.norm() - 1.0);
  if (norm_error > 1e-15 && norm_error <= kMaxQuaternionNormError) value.normalize();
  return "";
}

}  // namespace lio
