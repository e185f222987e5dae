// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/data_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace lio::sim {
namespace {

namespace fs = std::filesystem;

fs::path ConfigFolder() {
  if (const char* folder = std::getenv("LIO_CONFIG_DIR")) return folder;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const char* relative : {"../../config", "../config", "../share/liod/config"}) {
    const fs::path folder = program.parent_path() / relative;
    if (fs::is_directory(folder / "lidars", error)) return folder.lexically_normal();
  }
  throw std::runtime_error("no sensor files found: set LIO_CONFIG_DIR to liod's config folder");
}

}  // namespace

std::vector<std::string> ListDataFiles(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(ConfigFolder() / folder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path FindDataFile(const std::string& folder, const std::string& name) {
  std::error_code error;
  if (name.ends_with(".yaml") && fs::is_regular_file(name, error)) return name;
  const fs::path path = ConfigFolder() / folder / (name + ".yaml");
  if (fs::is_regular_file(path, error)) return path;
  std::string known;
  for (const std::string& model : ListDataFiles(folder)) known += " " + model;
  throw std::runtime_error("no model '" + name + "' in " + folder + "; there are:" + known);
}

}  // namespace lio::sim
