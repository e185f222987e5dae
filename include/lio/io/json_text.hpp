// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes JSON as text, whatever its strings hold.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lio {

// Returns one line. Bytes that are no UTF-8, which a note or a file's name may have, are replaced.
[[nodiscard]] inline std::string TextOf(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lio
