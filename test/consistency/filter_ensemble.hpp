// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs Monte Carlo simulations of the filter alone: many drives along one motion, with their own
// IMU noise, biases and start errors, and with registration replaced by a random draw.
//
// The truth of each run is the true error of the filter at its start, and true biases that follow a
// random walk. The map's frame is that in which the first scan was inserted, so the true pose in
// the map M begins at the filter's own. A measurement is Z = M ExpSe3(n). The choice of Map says
// how M changes when a scan is inserted at the filter's pose M_hat:
//   kFixed   not at all: white pose noise;
//   kGrown   a share phi of the map is now a map of M_hat: M = M_hat ExpSe3((1 - phi) mu + w);
//   kDrifts  by a random walk: M = M ExpSe3(w).
// Here w has the covariance phi q R, and R is that of n.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lio/eval/banded_series.hpp"
#include "lio/filter/pose_update.hpp"
#include "lio/filter/process_model.hpp"

namespace lio::test {

enum class Map { kFixed, kGrown, kDrifts };

// Names the measurement model of the filter.
enum class Belief {
  kMapPose,   // pose in the map, which blends as the map grows: the estimator's model
  kAbsolute,  // pose in the world, with white noise
};

struct EnsembleOptions {
  int num_runs = 100;
  std::uint64_t seed = 1;
  double duration_s = 30.0;
  Map map = Map::kFixed;
  Belief belief = Belief::kMapPose;
  double phi = 0.1;  // for a map that grows or drifts
  double q = 0.25;
  double position_std_m = 3e-3;  // noise of the registration
  double rotation_std_rad = 2e-4;
  ProcessNoise imu{5e-4, 5e-3, 2e-5, 2e-4};
  // The standard deviations and densities that the filter is given are the true ones times these
  // factors.
  double told_registration_ratio = 1.0;
  double told_imu_ratio = 1.0;
};

struct Block {
  std::string name;
  int begin;
  int size;
};
const std::vector<Block>& Blocks();  // position, rotation, velocity, gyro bias, accel bias

struct EnsembleResult {
  std::vector<BandedSeries> blocks;  // NEES, in the order of Blocks()
  std::vector<SigmaShares> shares;   // in the order of Blocks(), over all axes, instants and runs
  BandedSeries nis;                  // NIS of the innovations
  Whiteness whiteness;               // whiteness of their six whitened entries
};

EnsembleResult RunEnsemble(const EnsembleOptions& options);

// Returns one row per block: NEES, its share in the band, shares inside 1, 2, 3 sigma; then the
// innovations.
std::string Table(const EnsembleResult& result);

}  // namespace lio::test
