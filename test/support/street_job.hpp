// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Jobs of a RegistrationWorker, with sweeps of a drive along the street.
#pragma once

#include <memory>
#include <random>

#include "lio/pipeline/match_job.hpp"
#include "support/simulated_drive.hpp"

namespace lio::test {

// Returns a job that begins then, with the true motion and the true pose for its prior.
inline MatchJob StreetJob(double start_s) {
  std::mt19937_64 random(static_cast<unsigned>(1000 * start_s));
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(start_s);
  sweep->end = StampAt(start_s + 0.1);
  sweep->points = CastSweep(Street(), TestLidar(), Driving(), start_s, random);
  MatchJob job;
  job.sweep = sweep;
  for (int i = 0; i <= 10; ++i) {
    job.T_any_imu.push_back({StampAt(start_s + 0.01 * i), Driving()(start_s + 0.01 * i)});
  }
  job.prior.T_map_imu = Driving()(start_s + 0.05);
  job.prior.cov.diagonal() << Vector3::Constant(0.01), Vector3::Constant(2.5e-5);
  return job;
}

}  // namespace lio::test
