// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/data_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "lio/io/beam_table.hpp"

namespace lio::sim {
namespace fs = std::filesystem;

std::vector<std::string> ListDataFiles(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(ConfigDirectory() / folder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path FindDataFile(const std::string& folder, const std::string& name) {
  std::error_code error;
  if (name.ends_with(".yaml") && fs::is_regular_file(name, error)) return name;
  const fs::path path = ConfigDirectory() / folder / (name + ".yaml");
  if (fs::is_regular_file(path, error)) return path;
  std::string known;
  for (const std::string& model : ListDataFiles(folder)) known += " " + model;
  throw std::runtime_error("no model '" + name + "' in " + folder + "; there are:" + known);
}

}  // namespace lio::sim
