// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Options from YAML, strictly, and back as commented YAML. Keys are those of
// lio/pipeline/options_fields.hpp, nested as the structs are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/pipeline/options.hpp"

namespace lio {

struct LoadResult {
  Options options;                  // defaults where nothing valid was given
  std::vector<std::string> faults;  // one line each; empty means `options` is usable
};

// Defaults, then each file key by key, then each of `sets` ("a.b.c=VALUE", VALUE is YAML): later
// wins. Faults are all that can be found at once, each "file:line: message", or with the set's
// text, or "configuration: message" for what nobody gave: unreadable files, bad syntax, unknown
// keys (with the nearest right one), doubled keys, wrong types, values out of range, half-given
// groups, and what Validate finds in the whole. Quaternions are normalised. `null` takes an
// optional group back. Never throws for what the files hold.
LoadResult LoadOptions(const std::vector<std::filesystem::path>& files,
                       const std::vector<std::string>& sets);

// All options as YAML with a comment each; LoadOptions of the text gives the same values to the
// last bit. Optional groups that are absent are shown in comments.
std::string PrintOptions(const Options& options);

// The like without the count of threads, which changes no result.
std::string PrintResultOptions(const Options& options);

}  // namespace lio
