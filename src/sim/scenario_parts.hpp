// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Declares the parts that scenarios share and each scenario's maker; used inside src/sim only.
#pragma once

#include "lio/sim/scenario.hpp"
#include "sim/movers.hpp"
#include "sim/town.hpp"

namespace lio::sim {

inline constexpr double kStartRest_s = 2.5;
inline constexpr double kCarKnot_s = 0.2;
inline constexpr double kTownLane_m = 1.7;  // from a road's middle to the middle of a lane

// Mounts the sensors on the roof of a car: the lidar is turned by 90 degrees and 0.3 m above the
// IMU. Adds the car itself to the world.
void MountOnCar(Scenario& scenario, MotionPlan plan);
// Mounts the sensors on a hand-held rod; the person who carries it is half a metre behind.
void MountOnPerson(Scenario& scenario, MotionPlan plan);
// Mounts the sensors on the lid of a small robot, whose wheels stand on the ground.
void MountOnRobot(Scenario& scenario, MotionPlan plan);
// Mounts the sensors on top of a drone, whose feet are the body's origin.
void MountOnDrone(Scenario& scenario, MotionPlan plan);

// Returns how long the motion must be planned [s]: past the log's end, and including the run-up of
// a log that begins in motion.
[[nodiscard]] double PlannedSeconds(const Scenario& scenario, const ScenarioOptions& options);

// Lets the log begin at rest or, if asked, when the body has reached `moving_mps`.
void SetBegin(Scenario& scenario, const ScenarioOptions& options, double moving_mps);

// Returns the ground as HeightFunction.
[[nodiscard]] HeightFunction HeightOf(const Terrain& terrain);

// Each of these fills in everything but the name.
[[nodiscard]] Scenario MakeStreet(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeLoop(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeParked(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeSuburb(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeTunnel(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeMotorway(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeGarage(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeCampus(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeHall(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeOffice(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeMine(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeWarehouse(const ScenarioOptions& options);
[[nodiscard]] Scenario MakeHedgerows(const ScenarioOptions& options);

}  // namespace lio::sim
