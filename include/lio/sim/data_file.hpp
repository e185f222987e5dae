// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The sensors' data files, in the folder that lio::ConfigDirectory() finds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lio::sim {

// The file `<config>/<folder>/<name>.yaml`, or `name` itself when it is a file. Throws
// std::runtime_error naming the models there are.
std::filesystem::path FindDataFile(const std::string& folder, const std::string& name);

// The models of a folder, sorted.
std::vector<std::string> ListDataFiles(const std::string& folder);

}  // namespace lio::sim
