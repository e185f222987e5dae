// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Puts into words and YAML what is wrong with a rig whose inertial messages mean something else
// than it states. Turned axes and a turned extrinsic are the same to all that moves, so both are
// named; a corrected extrinsic keeps its translation, which was measured between the housings.
#pragma once

#include <string>
#include <vector>

#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

// Returns the causes, likeliest first, where `found` is what the messages are in.
[[nodiscard]] std::vector<Cause> ConventionCauses(const ImuConvention& found, const Rig& rig,
                                                  Trust leaves, const std::string& evidence);
// Returns what a user is to configure then, as a part of a sentence.
[[nodiscard]] std::string ConventionFix(const ImuConvention& found, const Rig& rig);

}  // namespace lio
