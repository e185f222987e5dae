// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scenario.hpp"

#include <stdexcept>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kLongest_s = 3600.0;

struct Maker {
  ScenarioEntry entry;
  Scenario (*make)(const ScenarioOptions& options);
  bool takes_carriers = false;
};

const std::vector<Maker>& Makers() {
  static const std::vector<Maker> makers = {
      {{"street", "a street canyon with shops, traffic, parked cars and people"}, MakeStreet},
      {{"loop", "once around a city block, back to where it began (690 m)"}, MakeLoop},
      {{"suburb", "a winding road between detached houses and gardens"}, MakeSuburb},
      {{"tunnel", "through a straight tunnel with plain walls"}, MakeTunnel},
      {{"motorway", "a motorway at 28 m/s among cars and trucks"}, MakeMotorway},
      {{"garage", "up the ramps of a multi-storey car park"}, MakeGarage},
      {{"campus", "on foot around a campus, sensor in hand"}, MakeCampus},
      {{"hall", "a sports hall, sensor in hand, turned at up to 300 deg/s"}, MakeHall},
      {{"office", "corridors, doors and stairs of an office, sensor in hand"}, MakeOffice},
      {{"mine", "a rough, narrow, dusty gallery with side drifts"}, MakeMine, true},
      {{"warehouse", "aisles between rows of equal racks, people, fork lifts"},
       MakeWarehouse,
       true},
      {{"hedgerows", "a lane of tilled soil between clipped hedges"}, MakeHedgerows, true},
      {{"parked", "parked at a crossing among traffic"}, MakeParked},
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
    if (options.duration_s && !(*options.duration_s > 0.0 && *options.duration_s <= kLongest_s)) {
      throw std::invalid_argument("the duration must be above 0 and at most 3600 s");
    }
    if (options.carrier && !maker.takes_carriers) {
      throw std::invalid_argument("the drive of '" + name + "' has a carrier of its own");
    }
    Scenario scenario = maker.make(options);
    scenario.name = name;
    return scenario;
  }
  throw std::invalid_argument("no scenario '" + name + "'; there are:" + known);
}

}  // namespace lio::sim
