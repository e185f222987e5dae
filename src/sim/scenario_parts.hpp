// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What the scenarios share, and each scenario's maker; used inside src/sim only.
#pragma once

#include "lio/sim/scenario.hpp"
#include "lio/sim/town.hpp"

namespace lio::sim {

inline constexpr double kStartRest_s = 2.5;
inline constexpr double kCarKnot_s = 0.2;

// A car with the sensors on its roof: the lidar turned by 90 degrees and 0.3 m above the IMU. Adds
// the car itself to the world.
void MountOnCar(Scenario& scenario, MotionPlan plan);
// A hand-held rod, its carrier half a metre behind it.
void MountOnPerson(Scenario& scenario, MotionPlan plan);

// For how long to plan the motion: past the log's end, and with the run-up of a log that begins in
// motion.
double PlannedSeconds(const Scenario& scenario, const ScenarioOptions& options);

// Begins the log at rest or, if asked, when the body has reached `moving_mps`.
void SetBegin(Scenario& scenario, const ScenarioOptions& options, double moving_mps);

// Ground as HeightFunction.
HeightFunction HeightOf(const Terrain& terrain);

// Each fills in everything but the name.
Scenario MakeStreet(const ScenarioOptions& options);
Scenario MakeLoop(const ScenarioOptions& options);
Scenario MakeParked(const ScenarioOptions& options);
Scenario MakeSuburb(const ScenarioOptions& options);
Scenario MakeTunnel(const ScenarioOptions& options);
Scenario MakeMotorway(const ScenarioOptions& options);
Scenario MakeGarage(const ScenarioOptions& options);
Scenario MakeCampus(const ScenarioOptions& options);
Scenario MakeHall(const ScenarioOptions& options);

}  // namespace lio::sim
