// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks at the header of a PLY file before PCL reads it: PCL aborts over some, and believes counts.
#pragma once

#include <filesystem>

namespace lio {

// False where the header is none, or the file cannot hold as many elements as it states.
[[nodiscard]] bool IsSoundPly(const std::filesystem::path& path);

}  // namespace lio
