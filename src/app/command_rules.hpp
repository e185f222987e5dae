// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which commands make sense, whatever the daemon is doing.
#pragma once

#include <string>

#include "lio/io/command.hpp"
#include "lio/pipeline/odometry.hpp"

namespace lio {

// Says in a sentence why the fields that the action uses are unusable; empty when they can be used.
[[nodiscard]] std::string WhyUnusable(const Command& command);

// Returns the pose of a command that is usable: its rotation normalized, no covariance where none
// is given.
[[nodiscard]] GivenPose PoseOf(const Command& command);

}  // namespace lio
