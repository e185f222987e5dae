// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks at a PCD file before PCL reads it: PCL believes the sizes that the file states.
#pragma once

#include <filesystem>

namespace lio {

// False where the header is none, or the file cannot hold as many points as it states.
[[nodiscard]] bool IsSoundPcd(const std::filesystem::path& path);

}  // namespace lio
