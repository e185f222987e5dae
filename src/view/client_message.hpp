// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads a message of the page to lio-view: a JSON object of these members, at most kMaxClientBytes
// long.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lio {

inline constexpr std::size_t kMaxClientBytes = 256;

struct ClientMessage {
  std::optional<std::uint32_t> ack;  // how many frames it has taken in
  std::optional<bool> play;          // false: pause
  std::optional<double> seek_s;
  std::optional<double> speed;
};

// Gives nothing for any other text.
[[nodiscard]] std::optional<ClientMessage> ParseClientMessage(std::string_view text);

}  // namespace lio
