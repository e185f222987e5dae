// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows an examiner a drive that proves the rig.
#pragma once

#include <gtest/gtest.h>

#include "lio/verdict/rig_examiner.hpp"
#include "verdict/rig_drive.hpp"

namespace lio::test {

// The examiner then knows that the rig is right within centimetres.
inline void KnowTheRig(RigExaminer& examiner) {
  examiner.record() = RecordDrive({.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()});
  (void)examiner.Look(StampAt(0.0));
  (void)examiner.Look(StampAt(40.0));
  ASSERT_TRUE(examiner.bounds());
}

}  // namespace lio::test
