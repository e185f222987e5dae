// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "lio/io/options_yaml.hpp"
#include "lio/pipeline/options_fields.hpp"

namespace lio {
namespace {

// Returns the shortest text that reads back as the same double and that YAML takes for a number:
// YAML 1.1, which PyYAML reads, wants a point in each.
std::string Text(double value) {
  std::string text = fmt::format("{}", value);
  const bool is_number = std::isfinite(value);
  if (is_number && text.find('.') == std::string::npos) {
    text.insert(std::min(text.find('e'), text.size()), ".0");
  }
  return text;
}
std::string Text(int value) {
  return fmt::format("{}", value);
}
std::string Text(bool value) {
  return value ? "true" : "false";
}
std::string Text(const std::string& value) {
  return value;
}
std::string Text(const Vector3& v) {
  return fmt::format("[{}, {}, {}]", Text(v.x()), Text(v.y()), Text(v.z()));
}
std::string Text(const Quaternion& q) {
  return fmt::format("[{}, {}, {}, {}]", Text(q.w()), Text(q.x()), Text(q.y()), Text(q.z()));
}
std::string Text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + Text(value);
  return "[" + text + "]";
}
template <class Enum>
requires std::is_enum_v<Enum> std::string Text(Enum value) {
  return std::string(EnumName(value));
}

std::string Limits(const Range& range) {
  return std::isinf(range.min) ? "" : fmt::format("; {} .. {}", range.min, range.max);
}
template <class T>
std::string Choices(const T& /*field*/) {
  std::string choices;
  if constexpr (std::is_enum_v<T>) {
    for (std::string_view name : kEnumNames<T>) {
      (choices += choices.empty() ? "; one of " : ", ") += name;
    }
  }
  return choices;
}

class Printer {
 public:
  // `left_out` is a key whose value is not printed, in any group.
  explicit Printer(std::string_view left_out = {}) : left_out_(left_out) {}

  template <class T>
  void operator()(const char* key, const T& field, const char* meaning, Range range = {}) {
    if (key == left_out_) return;
    if constexpr (kIsGroup<T>) {
      PrintGroup(key, field, meaning);
    } else {
      const std::string entry = indent_ + key + ": " + Text(field);
      text_ += fmt::format("{:<38} # {}{}{}\n", entry, meaning, Limits(range), Choices(field));
    }
  }
  // An absent group is shown with its keys in comments.
  template <class T>
  void operator()(const char* key, const std::optional<T>& field, const char* meaning) {
    if (field) {
      PrintGroup(key, *field, meaning);
      return;
    }
    const std::string outer = indent_;
    indent_ += "# ";
    PrintGroup(key, T{}, meaning);
    indent_ = outer;
  }

  // The fields that follow belong to this group.
  void Enter(const char* key) {
    text_ += fmt::format("{}{}:\n", indent_, key);
    indent_ += "  ";
  }

  const std::string& text() const { return text_; }

 private:
  template <class Group>
  void PrintGroup(const char* key, const Group& group, const char* meaning) {
    if (indent_.empty() && !text_.empty()) text_ += "\n";
    text_ += fmt::format("{:<38} # {}\n", indent_ + key + ":", meaning);
    const std::string outer = indent_;
    indent_ += "  ";
    VisitFields(*this, group);
    indent_ = outer;
  }

  std::string_view left_out_;
  std::string text_;
  std::string indent_;
};

constexpr std::string_view kBeamsHeader =
    "# The errors of the lidar's beams as this run found them. A run with the same lidar starts "
    "from\n"
    "# them when this file follows its rig: --config rig.yaml --config beams.yaml\n";

std::string Print(const Options& options, Printer printer) {
  VisitFields(printer, options);
  return "# Options of liod: value, meaning [unit]; valid range, ends included.\n" + printer.text();
}

}  // namespace

std::string PrintOptions(const Options& options) {
  return Print(options, Printer());
}

std::string PrintBeams(const LidarBeams& beams) {
  Printer printer;
  printer.Enter("rig");
  printer.Enter("lidar");
  printer("beams", beams, "measured minus true");
  return std::string(kBeamsHeader) + printer.text();
}

std::string PrintResultOptions(const Options& options) {
  return Print(options, Printer("num_threads"));
}

}  // namespace lio
