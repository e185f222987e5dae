// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads --initial-map and --initial-pose for the programs that can start in a map saved before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lio/pipeline/initial_map.hpp"
#include "lio/pipeline/options.hpp"

namespace CLI {
class App;
}

namespace lio {

struct InitialMapArguments {
  std::filesystem::path map;  // empty: none
  std::string pose;           // x, y, z [m], yaw [deg], with commas between; or empty
};

// `arguments` must outlive the app.
void AddInitialMapArguments(CLI::App& app, InitialMapArguments& arguments);

// Returns the points of a PCD or PLY file that has x, y and z as floats, without those that are no
// numbers. Throws InputError, naming the file, when it is missing, damaged or of another kind, or
// has points that nobody can start in.
[[nodiscard]] std::vector<Eigen::Vector3f> LoadMapPoints(const std::filesystem::path& path);

// Loads the map where one is asked for. Nothing means that the program goes on; otherwise it ends
// now with this exit code, and the reason is on stderr in one line that begins with `program`.
[[nodiscard]] std::optional<int> LoadInitialMap(const std::string& program,
                                                const InitialMapArguments& arguments,
                                                const Options& options, InitialMapPtr& map);

}  // namespace lio
