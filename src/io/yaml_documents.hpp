// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the one document of a configuration file.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

namespace lio {

struct YamlDocument {
  YAML::Node first;                     // null where the text has none
  std::optional<YAML::Mark> second_at;  // begin of another one
};

// Throws YAML::Exception for text that is no YAML. YAML::LoadAll would find documents without end
// in text that begins with a comma, so no more than two are looked for.
[[nodiscard]] YamlDocument LoadYamlDocument(const std::string& text);

}  // namespace lio
