// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the sensors' data files in the folder that lio::ConfigDirectory() returns.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lio::sim {

// Returns the path of `<config>/<folder>/<name>.yaml`, or `name` itself when it is a YAML file.
// Throws std::runtime_error that lists the models of the folder when there is none of that name.
[[nodiscard]] std::filesystem::path FindDataFile(const std::string& folder,
                                                 const std::string& name);

// Returns the names of the models in a folder, sorted.
[[nodiscard]] std::vector<std::string> ListDataFiles(const std::string& folder);

}  // namespace lio::sim
