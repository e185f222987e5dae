// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Remembers an IMU that scans contradict.
#pragma once

#include "pipeline/imu_agreement.hpp"

namespace lio {

// A unit that scans contradict is not believed until it follows them again.
struct ImuDoubt {
  ImuContradiction contradiction;
  Timestamp last;  // the last scan that contradicted it
  // As they were before.
  Biases biases;
  Vector3 g_world = Vector3::Zero();  // m/s^2
  int num_before = 0;                 // doubts that were given up
  bool is_open = true;
};

}  // namespace lio
