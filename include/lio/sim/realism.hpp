// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Grades how true to life the simulated sensors are, and switches single effects off, so that what
// each one costs an estimator can be measured (docs/simulator.md).
#pragma once

#include <string>
#include <vector>

#include "lio/sim/recorder.hpp"

namespace lio::sim {

enum class Realism {
  kIdeal,      // every beam returns the exact range, and the IMU is exact
  kDatasheet,  // the errors that the sensors' data sheets state
  kField,      // and those that a sensor has on a vehicle
};

// Returns the names of the effects that `field` adds, in the order of the help text.
[[nodiscard]] std::vector<std::string> FieldEffects();

// Names effects of the field that are added to a grade or left out of it; left out wins.
struct EffectChoice {
  std::vector<std::string> with;
  std::vector<std::string> without;
};

// Sets the errors of the sensors in `options` to those of the grade and the choice. Throws
// std::invalid_argument that lists the effects when there is none of a name.
void SetRealism(Realism realism, const EffectChoice& choice, RecordOptions& options);

}  // namespace lio::sim
