// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/client_message.hpp"

#include <nlohmann/json.hpp>

namespace lio {

std::optional<ClientMessage> ParseClientMessage(std::string_view text) {
  if (text.size() > kMaxClientBytes) return std::nullopt;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  ClientMessage message;
  for (const auto& [name, value] : json.items()) {
    if (name == "ack" && value.is_number_unsigned()) {
      message.ack = static_cast<std::uint32_t>(value.get<std::uint64_t>());
    } else if (name == "play" && value.is_boolean()) {
      message.play = value.get<bool>();
    } else if (name == "seek_s" && value.is_number()) {
      message.seek_s = value.get<double>();
    } else if (name == "speed" && value.is_number()) {
      message.speed = value.get<double>();
    } else {
      return std::nullopt;
    }
  }
  return message;
}

}  // namespace lio
