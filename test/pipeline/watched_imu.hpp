// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A body whose inertial samples and matched poses an ImuConventionMonitor sees.
#pragma once

#include <utility>
#include <vector>

#include "pipeline/imu_convention_monitor.hpp"
#include "support/motion.hpp"

namespace lio {

inline constexpr int kManySteps = 60;  // six seconds: enough for a verdict
inline const ImuConvention kSi;
inline const ImuConvention kG{true, false};
inline const ImuConvention kDeg{false, true};

// A body whose samples, at 50 Hz, are in `sent_as` and whose exact poses, at 10 Hz, a monitor sees.
class Watched {
 public:
  explicit Watched(const ImuConvention& sent_as, test::Motion motion = test::WindingDrive(0.0))
      : sent_as_(sent_as), motion_(std::move(motion)) {}

  void AddStep() {
    std::vector<ImuReady> ready;
    for (int i = 0; i < 5; ++i) {
      const double t_s = 0.1 * num_steps_ + 0.02 * i;
      (void)imu.Add(FromSi(sent_as_, test::ExactSample(motion_, t_s, g_world)), ready);
    }
    const double t_s = 0.1 * num_steps_++ + 0.08;
    monitor.AddPose({test::StampAt(t_s), T_map_world * (matched ? matched : motion_)(t_s)});
  }
  void AddSteps(int num) {
    for (int i = 0; i < num; ++i) AddStep();
  }
  // The samples are read as they are meant from here on, or otherwise.
  void Believe(const ImuConvention& convention) {
    imu.SetConvention(convention);
    monitor.Restart();
  }
  ImuConventionMonitor::Finding Judge() { return monitor.JudgeInitializing({}, false); }
  ImuConventionMonitor::TrackingFacts Facts(int num_gated_lately = 0) const {
    return {test::StampAt(0.1 * num_steps_), 0, num_gated_lately, Vector3::Zero()};
  }
  Timestamp now() const { return test::StampAt(0.1 * num_steps_); }

  Rig rig;
  Counters counters;
  ImuBuffer imu{kSi, counters};
  ImuConventionMonitor monitor{rig, imu};
  Vector3 g_world = test::kGravity;
  Pose T_map_world;
  test::Motion matched;  // motion that scan matching sees, if it is another

 private:
  ImuConvention sent_as_;
  test::Motion motion_;
  int num_steps_ = 0;
};

}  // namespace lio
