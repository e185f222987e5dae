// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator for programs that link it: samples and sweeps in, poses out. Each call does all the
// work that its data make possible before it returns; matching a sweep takes milliseconds.
//
//   lio::Options options;                        // plain structs with defaults
//   options.rig.T_imu_lidar = lio::Pose{rotation, translation};
//   lio::SynchronousOdometry odometry(options);
//   odometry.AddImu(sample);                     // in the order in which they were measured
//   odometry.AddSweep(std::move(sweep));
//   for (const lio::Output& output : odometry.TakeOutputs()) {
//     const auto* scan = std::get_if<lio::ScanOutput>(&output);
//     if (scan != nullptr && scan->filter) Use(scan->filter->nav.T_world_imu);
//   }
//
// A sweep is matched as soon as the inertial samples reach its end, so its output may come with a
// later call. The results depend only on the data and their order, never on a clock or on
// options.pipeline.num_threads. Objects are independent of each other; one object is used by one
// thread at a time.
//
// Options are filled in by code. Reading them from YAML files is part of the programs (lio_io) and
// is not installed.
#pragma once

#include <memory>
#include <vector>

#include "lio/pipeline/odometry.hpp"
#include "lio/sensor/lidar_sweep.hpp"

namespace lio {

class SynchronousOdometry {
 public:
  // Throws std::invalid_argument naming every fault of the options; Validate(options) lists them.
  // `beam_elevations_rad`: of the lidar's beams, lowest first; only the LOAM method uses them, for
  // sweeps whose points have no rings. `clock`: gives the CPU time for ScanReport::stage_ns.
  explicit SynchronousOdometry(const Options& options,
                               const std::vector<double>& beam_elevations_rad = {},
                               ClockNs clock = nullptr);
  ~SynchronousOdometry();
  SynchronousOdometry(SynchronousOdometry&&) noexcept;
  SynchronousOdometry& operator=(SynchronousOdometry&&) noexcept;

  // Samples that are not finite, out of range, late or twice there are ignored and counted.
  void AddImu(const ImuSample& sample);

  // One turn of the lidar, of at most 0.5 s. Sweeps come in order of time; each may come before or
  // after the inertial samples of its span. Points without a time of their own have t_offset_ns 0,
  // which says that all were measured at `stamp`.
  void AddSweep(LidarSweep sweep);

  // A part of a sweep, for sensors that send parts. The chunks of all sweeps are numbered by the
  // caller (ScanChunk::scan_seq); use either this or AddSweep for one lidar, since AddSweep numbers
  // its sweeps itself.
  void AddChunk(ScanChunk chunk);

  // The data have ended: matches what still waits for inertial samples or for missing chunks.
  void Flush();

  // Everything that happened since the last call, in order: one ScanOutput per matched sweep, one
  // NavOutput of source kImuPropagated per inertial sample once the estimator has started, and
  // notices in words. Call it regularly, since outputs are kept until they are taken.
  [[nodiscard]] std::vector<Output> TakeOutputs();

  // Only when KeepMapClouds(true) was called: the points that were added to the local map since
  // the last call, one cloud per sweep, in the frame `map` [m].
  void KeepMapClouds(bool keeps);
  [[nodiscard]] std::vector<std::vector<Eigen::Vector3f>> TakeMapClouds();

  const Counters& counters() const;  // all that was lost, refused or odd
  TrackingStatus status() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
