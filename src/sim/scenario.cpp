// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scenario.hpp"

#include <stdexcept>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

struct Maker {
  ScenarioEntry entry;
  Scenario (*make)(const ScenarioOptions& options, double duration_s);
};

const std::vector<Maker>& Makers() {
  static const std::vector<Maker> makers = {
      {{"street", "a street canyon with shops, traffic, parked cars and people", 60.0}, MakeStreet},
  };
  return makers;
}

}  // namespace

const std::vector<ScenarioEntry>& AllScenarios() {
  static const std::vector<ScenarioEntry> entries = [] {
    std::vector<ScenarioEntry> all;
    for (const Maker& maker : Makers()) all.push_back(maker.entry);
    return all;
  }();
  return entries;
}

Scenario MakeScenario(const std::string& name, const ScenarioOptions& options) {
  std::string known;
  for (const Maker& maker : Makers()) {
    known += " " + maker.entry.name;
    if (maker.entry.name != name) continue;
    const double duration_s = options.duration_s.value_or(maker.entry.duration_s);
    if (!(duration_s > 0.0)) throw std::invalid_argument("the duration must be positive");
    Scenario scenario = maker.make(options, duration_s);
    scenario.name = name;
    scenario.duration_s = duration_s;
    return scenario;
  }
  throw std::invalid_argument("no scenario '" + name + "'; there are:" + known);
}

}  // namespace lio::sim
