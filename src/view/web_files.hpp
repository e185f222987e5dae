// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Serves the files of the page, which are compiled in.
#pragma once

#include <optional>
#include <string_view>

namespace lio {

struct WebFile {
  std::string_view type;  // MIME type
  std::string_view content;
};

// Returns the file at a path such as "/" or "/main.js"; nothing for any other path.
[[nodiscard]] std::optional<WebFile> FindWebFile(std::string_view path);

}  // namespace lio
