// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_schema.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "lio/convert/ros_messages.hpp"

namespace lio {
namespace {

constexpr int kMaxNesting = 16;  // nested messages; ROS itself has none that deep
constexpr int kMaxNamedElements = 16;
constexpr int kMaxFixedCount = 1 << 20;
constexpr int kMaxValues = 1 << 22;  // values of one message

struct Primitive {
  std::string_view name;
  double (*read)(RosCursor&);
};

template <typename T>
double ReadAs(RosCursor& cursor) {
  return static_cast<double>(cursor.Read<T>());
}

constexpr std::array<Primitive, 13> kPrimitives = {{{"bool", ReadAs<std::uint8_t>},
                                                    {"byte", ReadAs<std::uint8_t>},
                                                    {"char", ReadAs<std::uint8_t>},
                                                    {"int8", ReadAs<std::int8_t>},
                                                    {"uint8", ReadAs<std::uint8_t>},
                                                    {"int16", ReadAs<std::int16_t>},
                                                    {"uint16", ReadAs<std::uint16_t>},
                                                    {"int32", ReadAs<std::int32_t>},
                                                    {"uint32", ReadAs<std::uint32_t>},
                                                    {"int64", ReadAs<std::int64_t>},
                                                    {"uint64", ReadAs<std::uint64_t>},
                                                    {"float32", ReadAs<float>},
                                                    {"float64", ReadAs<double>}}};

const Primitive* FindPrimitive(std::string_view type) {
  for (const Primitive& primitive : kPrimitives) {
    if (primitive.name == type) return &primitive;
  }
  return nullptr;
}

std::string_view Trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string_view NextLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool IsRule(std::string_view line) {
  return line.size() >= 3 && line.find_first_not_of('=') == std::string_view::npos;
}

// Returns the full name of the message that `type` may mean in a field of a message of `package`.
std::string FullName(const std::string& type, const std::string& package) {
  if (type == "Header") return "std_msgs/Header";
  return type.find('/') == std::string::npos ? package + "/" + type : type;
}

}  // namespace

std::optional<RosSchema> RosSchema::Parse(std::string_view definition, std::string_view type) {
  RosSchema schema;
  schema.messages_.push_back({Ros1TypeName(type), {}});
  while (!definition.empty()) {
    std::string_view line = NextLine(definition);
    line = Trim(line.substr(0, line.find('#')));
    if (line.empty() || IsRule(line)) continue;
    if (line.substr(0, 4) == "MSG:") {
      schema.messages_.push_back({Ros1TypeName(Trim(line.substr(4))), {}});
    } else if (!schema.ParseLine(line, schema.messages_.back())) {
      return {};
    }
  }
  if (!schema.Link()) return {};
  return schema;
}

// Parses a line such as "float64[9] covariance", "uint8 GOOD = 3" or "string<=10 name".
bool RosSchema::ParseLine(std::string_view line, Message& message) const {
  const std::size_t blank = line.find_first_of(" \t");
  if (blank == std::string_view::npos) return false;
  std::string_view type = line.substr(0, blank);
  std::string_view rest = Trim(line.substr(blank));
  if (rest.find('=') != std::string_view::npos) return true;  // this is a constant
  Field field;
  field.name =
      rest.substr(0, rest.find_first_of(" \t"));  // ROS 2 writes a default value after the name
  const std::size_t bracket = type.find('[');
  if (bracket != std::string_view::npos) {
    const std::string_view count = type.substr(bracket + 1);
    const char* end = count.data() + count.size();
    int value = -1;
    const auto parsed = std::from_chars(count.data(), end, value);
    const bool fixed = parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == ']';
    if (fixed && (value < 0 || value > kMaxFixedCount)) return false;
    if (!fixed && count != "]" && count.substr(0, 2) != "<=") return false;
    field.fixed_count = fixed ? value : -1;
    field.is_sequence = !fixed;
    type = type.substr(0, bracket);
  }
  field.type = Ros1TypeName(type.substr(0, type.find("<=")));
  if (field.type.empty() || field.name.empty()) return false;
  message.fields.push_back(std::move(field));
  return true;
}

// Finds the field's type. Returns false for a message that is not defined.
bool RosSchema::LinkField(Field& field, const std::string& package, const MessageIndex& index) {
  if (FindPrimitive(field.type) != nullptr) {
    field.kind = Kind::kNumber;
  } else if (field.type == "string" || field.type == "wstring") {
    field.kind = Kind::kString;
  } else if (field.type == "time" || field.type == "duration") {
    field.kind = Kind::kTime;
  } else {
    field.kind = Kind::kMessage;
    const auto same = index.find(field.type);
    const auto full = index.find(FullName(field.type, package));
    if (same == index.end() && full == index.end()) return false;
    field.message = same == index.end()   ? full->second
                    : full == index.end() ? same->second
                                          : std::min(same->second, full->second);
  }
  return true;
}

// Finds the message of every field that is one. Returns false when a type is not defined.
bool RosSchema::Link() {
  MessageIndex index;
  for (std::size_t i = 1; i < messages_.size(); ++i) index.try_emplace(messages_[i].type, i);
  for (Message& message : messages_) {
    const std::size_t slash = message.type.find('/');
    const std::string package =
        slash == std::string::npos ? std::string() : message.type.substr(0, slash);
    for (Field& field : message.fields) {
      if (!LinkField(field, package, index)) return false;
    }
  }
  return !messages_.front().fields.empty();
}

std::optional<RosNumbers> RosSchema::Read(ByteView bytes, RosEncoding encoding) const {
  Walk walk{RosCursor(bytes, encoding), {}, kMaxValues};
  if (!ReadMessage(walk, 0, "") || !walk.cursor.AtEnd()) return {};
  return std::move(walk.numbers);
}

bool RosSchema::ReadMessage(Walk& walk, std::size_t message, const std::string& prefix) const {
  if (++walk.depth > kMaxNesting) return false;
  for (const Field& field : messages_[message].fields) {
    const std::string name = prefix.empty() && message != 0 ? "" : prefix + field.name;
    if (field.fixed_count < 0 && !field.is_sequence) {
      if (!ReadField(walk, field, name)) return false;
      continue;
    }
    const std::uint32_t count = field.is_sequence ? walk.cursor.ReadCount(1)
                                                  : static_cast<std::uint32_t>(field.fixed_count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool named = i < kMaxNamedElements && !name.empty();
      const std::string element = named ? name + '[' + std::to_string(i) + ']' : std::string();
      if (!ReadField(walk, field, element)) return false;
    }
  }
  --walk.depth;
  return walk.cursor.ok();
}

bool RosSchema::ReadField(Walk& walk, const Field& field, const std::string& name) const {
  if (--walk.num_values_left < 0) return false;
  double value = 0.0;
  switch (field.kind) {
    case Kind::kNumber:
      value = FindPrimitive(field.type)->read(walk.cursor);
      break;
    case Kind::kTime:
      value = 1e-9 * static_cast<double>(walk.cursor.ReadTime().ns);
      break;
    case Kind::kString:
      walk.cursor.ReadString();
      return walk.cursor.ok();
    case Kind::kMessage:
      return ReadMessage(walk, field.message, name.empty() ? "" : name + '.');
  }
  if (!name.empty()) walk.numbers.insert_or_assign(name, value);
  return walk.cursor.ok();
}

}  // namespace lio
