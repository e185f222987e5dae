// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the parts of the page that need the truth: figures, the true path, and errors with the
// standard deviations that the filter claims.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lio/eval/evaluation.hpp"

namespace lio {

// Returns an object with "figures" (as lio-eval --json), "path" (the truth in the estimate's frame)
// and "errors"; either of the last two is missing where it cannot be had, and "note" says why there
// are no figures; "remark" tells what the errors leave out. `begin` is the page's time zero.
[[nodiscard]] nlohmann::ordered_json TruthParts(const std::filesystem::path& folder,
                                                const std::filesystem::path& truth,
                                                Timestamp begin);

}  // namespace lio
