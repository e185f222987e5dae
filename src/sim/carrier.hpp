// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes the sensors along a way by hand, on a small robot or on a drone: how fast, how it leans,
// sways and looks about. It is used inside src/sim only.
#pragma once

#include "sim/drive.hpp"
#include "sim/scenario_parts.hpp"

namespace lio::sim {

inline constexpr double kCarrierKnot_s = 0.1;

[[nodiscard]] DriveLimits LimitsOf(Carrier carrier);

// Fills in trajectory, mount and shaking. `floor` gives the height of the ground along the way; a
// drone takes off from there and flies `flight_m` above it.
void CarryAlong(Scenario& scenario, Carrier carrier, const Path& way, const HeightFunction& floor,
                double flight_m, const ScenarioOptions& options);

// Turns the sensor aside and back, as a head is turned, and up and down, at up to `fastest_radps`.
void AddGlances(std::vector<BodyKnot>& knots, double knot_interval_s, double fastest_radps,
                Random& random);

}  // namespace lio::sim
