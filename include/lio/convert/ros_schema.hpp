// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads messages of any type with the definition that the bag stores, for types whose layout
// differs between drivers of the same name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lio/convert/ros_cursor.hpp"

namespace lio {

// Holds the numbers of one message by dotted name ("nov_header.gps_week_number"). Elements of
// arrays of up to 16 numbers are named "name[3]"; times are in seconds. Strings and longer arrays
// are skipped.
using RosNumbers = std::map<std::string, double, std::less<>>;

class RosSchema {
 public:
  // `definition` lists the message's fields, then those of the types it uses, each after a line of
  // "=" and "MSG: package/Type", as ROS writes it. `type` is the message's own type,
  // "package/Type". Returns nothing when a type is missing or a line is no field.
  [[nodiscard]] static std::optional<RosSchema> Parse(std::string_view definition,
                                                      std::string_view type);

  // Returns nothing when the bytes are not exactly such a message.
  [[nodiscard]] std::optional<RosNumbers> Read(ByteView bytes, RosEncoding encoding) const;

 private:
  enum class Kind { kNumber, kString, kTime, kMessage };
  struct Field {
    std::string name;
    std::string type;  // as written, without the array's brackets
    Kind kind = Kind::kNumber;
    std::size_t message = 0;  // index into messages_
    int fixed_count = -1;     // length of a fixed-size array; -1: no such array
    bool is_sequence = false;
  };
  struct Message {
    std::string type;
    std::vector<Field> fields;
  };

  [[nodiscard]] bool ParseLine(std::string_view line, Message& message) const;
  // Gives the index into messages_ of the first message of each type.
  using MessageIndex = std::unordered_map<std::string, std::size_t>;
  [[nodiscard]] static bool LinkField(Field& field, const std::string& package,
                                      const MessageIndex& index);
  [[nodiscard]] bool Link();
  struct Walk {
    RosCursor cursor;
    RosNumbers numbers;
    int num_values_left;  // limits what a hostile definition can ask for
    int depth = 0;
  };
  [[nodiscard]] bool ReadMessage(Walk& walk, std::size_t message, const std::string& prefix) const;
  // The value is skipped when the name is empty.
  [[nodiscard]] bool ReadField(Walk& walk, const Field& field, const std::string& name) const;

  std::vector<Message> messages_;  // the first is the message itself
};

}  // namespace lio
