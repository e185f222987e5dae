// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs lidar-only odometry for calibration: it gives the lidar's pose in the map at each sweep's
// middle, by the lidar's own clock.
//
// Does: assembles sweeps, predicts by constant velocity (constant_velocity_tracker.hpp), deskews,
// matches against the map, inserts keyframes. No extrinsic is used: the lidar is the body. Given a
// known path (calib/sweep_path.hpp), the motion prior and the deskewing are the path's: a second
// pass without the skew that a constant velocity leaves.
#pragma once

#include <memory>
#include <optional>

#include "lio/calib/sweep_path.hpp"
#include "lio/pipeline/constant_velocity_tracker.hpp"
#include "lio/pipeline/keyframe_policy.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "lio/stream/scan_assembler.hpp"

namespace lio {

class ScanPoses {
 public:
  // Throws std::invalid_argument naming every fault of the options. `path` is borrowed and must
  // outlive this object.
  explicit ScanPoses(const Options& options, const SweepPath* path = nullptr);

  void Add(ScanChunk chunk);
  void Finish();  // closes the last sweeps: the log has ended

  const StampedPoses& found() const { return found_; }  // T_map_lidar at the sweeps' middles
  int num_unmatched() const { return num_unmatched_; }
  const Counters& counters() const { return counters_; }

 private:
  void MatchClosed();
  void Match(std::shared_ptr<const Sweep> sweep);
  MatchJob JobByTracker(std::shared_ptr<const Sweep> sweep);
  MatchJob JobAlongPath(std::shared_ptr<const Sweep> sweep) const;

  const SweepPath* path_;
  Counters counters_;
  ScanAssembler assembler_{counters_};
  RegistrationWorker matching_;
  std::optional<ConstantVelocityTracker> tracker_;
  KeyframePolicy keyframes_;
  std::optional<Timestamp> last_found_;
  StampedPoses found_;
  int num_unmatched_ = 0;
};

}  // namespace lio
