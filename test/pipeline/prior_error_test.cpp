// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/prior_error.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

// 0.1 s after the last scan the prior is off by 0.1 rad, so the turn rate is by 1 rad/s: the
// sweep's beginning is off by half as much, its end by half as much again.
TEST(PriorError, HasGrownSinceTheLastScan) {
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(1.0);
  sweep->end = StampAt(1.1);
  MatchJob job;
  job.sweep = sweep;
  job.prior.since_last_fix_s = 0.1;
  for (const double t_s : {1.0, 1.05, 1.1}) job.T_any_imu.push_back({StampAt(t_s), Pose{}});
  Vector6 correction = Vector6::Zero();
  correction[5] = 0.1;
  CorrectPrior(correction, job);
  const double yaws_rad[] = {0.05, 0.1, 0.15};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(LogSo3(job.T_any_imu[i].pose.rotation).z(), yaws_rad[i], 1e-9) << i;
  }
  EXPECT_NEAR(LogSo3(job.prior.T_map_imu.rotation).z(), 0.1, 1e-9);
}

}  // namespace
}  // namespace lio
