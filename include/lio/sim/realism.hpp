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
std::vector<std::string> FieldEffects();

// Sets the errors of the sensors in `options` to those of the grade, without the effects named in
// `without`. Throws std::invalid_argument that lists the effects when there is none of that name.
void SetRealism(Realism realism, const std::vector<std::string>& without, RecordOptions& options);

}  // namespace lio::sim
