// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the rig of a simulated vehicle as configuration for lio-replay and liod.
#pragma once

#include <filesystem>

#include "lio/sim/recorder.hpp"

namespace lio::sim {

// Writes only the keys that describe the vehicle. The densities are the sensor's own; the part of
// its bias instability that looks like a random walk is added to the walk. Throws
// std::runtime_error when the file cannot be written.
void WriteRigFile(const std::filesystem::path& path, const Scenario& scenario,
                  const RecordOptions& options);

}  // namespace lio::sim
