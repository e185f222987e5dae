// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Loads options from YAML, strictly, and prints them as commented YAML. The keys are those of
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

// Takes the defaults, then each file key by key, then each of `sets` ("a.b.c=VALUE", VALUE is
// YAML); later values win. `null` removes an optional group. Quaternions are normalised.
//
// All faults are reported at once: unreadable files, bad syntax, unknown keys (with the nearest
// right one), doubled keys, wrong types, values out of range, groups given in part, and the faults
// that Validate finds in the whole. Each reads "file:line: message", or begins with the set's text,
// or with "configuration:" when it is about a key that was not given. The contents of the files
// never make this throw.
[[nodiscard]] LoadResult LoadOptions(const std::vector<std::filesystem::path>& files,
                                     const std::vector<std::string>& sets);

// Prints all options as YAML with a comment each. LoadOptions of the text gives the same values to
// the last bit. Optional groups that are absent are shown in comments.
[[nodiscard]] std::string PrintOptions(const Options& options);

// Prints the beams alone, as rig.lidar.beams, for a file that follows the rig's.
[[nodiscard]] std::string PrintBeams(const LidarBeams& beams);

// Prints all options without the number of threads, which changes no result.
[[nodiscard]] std::string PrintResultOptions(const Options& options);

}  // namespace lio
