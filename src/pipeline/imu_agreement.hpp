// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Do the inertial samples follow the motion that scans show? A gyro or an accelerometer that has
// died, is stuck or has lost an axis goes on sending samples, and the filter believes them more
// than the scans.
//
// Matched poses are compared with the samples between them, over several spans:
//
//   turns  Log(dR^T R_0^T R_1), with dR the integral of the rates less their bias,
//   bends  p_2 - p_1 - (p_1 - p_0) t_12 / t_01, less what gravity and the forces make of it: no
//          velocity enters.
//
// A sensor is contradicted when the difference exceeds what noise, the rig and the clocks may leave
// four times in a row, or three times where it is twice as large, in the same direction: a match
// that is wrong by itself moves one pose, and the next difference points the other way. Nothing
// throws.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/filter/preintegration.hpp"
#include "lio/sensor/imu_noise.hpp"
#include "lio/stream/imu_buffer.hpp"
#include "lio/verdict/rig_findings.hpp"
#include "pipeline/stuck_imu.hpp"

namespace lio {

struct ImuAgreementParameters {
  // Scans. Chosen: a dead sensor is seen before matching loses the way, within half a second at 10
  // Hz, and one that is off by a little within two.
  std::array<std::size_t, 4> spans{1, 2, 4, 8};
  // So many differences in a row contradict that are so large in their mean, over what they may be.
  // One wrong match makes two. Three sufficed for a narrow view that slid at the corner of an
  // office, with 1.0 to 1.4; four were not seen there, nor three twice as large
  // (docs/experiments/dead_imu.md).
  struct Run {
    std::size_t num;
    double min_mean;
  };
  std::array<Run, 2> runs{{{3, 2.0}, {4, 1.0}}};  // longer ones last
  // The same for turns from scan to scan after the poses have jumped, since a gyro that jumps makes
  // the next match a bad one. Chosen: twice as many as without a jump.
  std::array<Run, 1> runs_after_jump{{{8, 2.0}}};
  // Each of them exceeds this share of what it may be: an error that has just begun is growing.
  // Chosen.
  double min_share = 0.5;
  double sigmas = 2.0;  // statistics: noise does this three times in a row once in 80 000
  // These errors are a rig's, not those of a broken sensor. On sound drives differences stay below
  // half of what they leave (docs/experiments/dead_imu.md).
  double scale_error = 0.02;      // chosen, of turn or bend: twice a bad data sheet's
  double bias_stds = 3.0;         // statistics: 99.7 %, of the rig's standard deviation
  double min_rate_radps = 0.006;  // chosen: a third of a degree per second
  double min_force_mps2 = 0.08;   // chosen: gravity under half a degree of tilt
  // Nothing is known of the rig yet: it may be wrong by this. Chosen: 6 deg, the size of a lidar,
  // and what is left of an offset between clocks that somebody has configured.
  double rotation_error_rad = 0.1;
  double lever_error_m = 0.2;
  double clock_error_s = 0.02;
  std::size_t max_poses = 200;  // chosen: 10 s at 20 Hz
  // s. Samples that have followed scans in motion for so long are of the right unit and axes.
  // Chosen: a wrong unit contradicts the first three scans in motion.
  double min_followed_s = 3.0;
  double motion_mps = 0.3;  // chosen: these are a motion
  double motion_radps = 0.05;
  // Poses that the samples leave bent by more have jumped, and tell nothing until the samples have
  // followed them again for as long. Chosen: one and a half times gravity, and 15 cm at 10 Hz.
  double jump_mps2 = 15.0;
  // A sensor follows again once scans have shown this share of the motion that it did not follow,
  // over so many scans. Chosen: half, which the limits above would not let pass either; a span over
  // which the noise of poses is small.
  double shown_share = 0.5;
  std::size_t shown_span = 4;
};

inline constexpr ImuAgreementParameters kImuAgreement;

// Returns the samples from the one instant to the other, and a few beside them to interpolate with.
[[nodiscard]] std::vector<ImuSample> SamplesAbout(const ImuBuffer& imu, Timestamp from,
                                                  Timestamp to);

struct ImuContradiction {
  ImuSensor sensor = ImuSensor::kGyro;
  Timestamp since;                     // here the samples still followed
  Vector3 axis_imu = Vector3::Zero();  // unit, along the difference
  double seen = 0.0;                   // the motion along it that scans showed, rad/s or m/s^2
  std::string evidence;
};

// Returns an axis that has stopped, as a contradiction; whatever the scans show from then on, the
// sensor does not follow it.
[[nodiscard]] ImuContradiction ContradictionOf(const StuckImuDetector::Stuck& stuck,
                                               Timestamp since);

class ImuAgreement {
 public:
  struct MatchedPose {
    Timestamp stamp;
    Pose T_map_imu;
    Matrix6 cov = Matrix6::Zero();  // right error [m; rad]
  };
  // Holds what is believed of the IMU.
  struct Belief {
    Biases biases;
    ImuNoise noise;
    Vector3 g_map = Vector3::Zero();   // m/s^2; zero where no gravity is felt
    double gyro_bias_std_radps = 0.0;  // the rig's
    double accel_bias_std_mps2 = 0.0;
    std::optional<RigBounds> rig = {};         // the drive has shown this of it
    std::optional<double> clock_error_s = {};  // the stamps may be off by so much
    [[nodiscard]] double rotation_error_rad() const;
    [[nodiscard]] double lever_error_m() const;
  };
  // `samples` cover the time since the last pose; without any it begins anew.
  void Add(const MatchedPose& pose, std::span<const ImuSample> samples, const Belief& belief);
  // Takes those samples, and none where some are missing or saturated, so that they do not tell the
  // motion.
  void Add(const MatchedPose& pose, const ImuBuffer& imu, const Belief& belief);
  void Restart() { poses_.clear(); }
  std::optional<Timestamp> last() const;

  // Does the newest pose contradict the samples?
  [[nodiscard]] std::optional<ImuContradiction> Find(const Belief& belief) const;
  // Does it contradict the gyro, though the poses have jumped before?
  [[nodiscard]] std::optional<ImuContradiction> FindAfterJump(const Belief& belief) const;
  // Have scans shown a motion since `from` that would have been contradicted as that one was, if
  // the sensor still were as it was then?
  [[nodiscard]] bool HasShownAlike(const ImuContradiction& earlier, Timestamp from) const;

  // Holds the motion of the last two steps from scan to scan, as the poses show it.
  struct Motion {
    Vector3 v_imu_mps = Vector3::Zero();
    Vector3 w_imu_radps = Vector3::Zero();
  };
  [[nodiscard]] std::optional<Motion> MotionNow() const;
  // Are the last three poses bent by more than any broken sensor would leave? Then matching has
  // gone over to another part of the map, as where a loop closes, or was wrong.
  [[nodiscard]] bool HasJumped(const Belief& belief) const;
  // Do the last two steps show a motion?
  [[nodiscard]] bool HasMoved() const;

 private:
  // Holds a pose and what the samples tell since the one before.
  struct Entry {
    MatchedPose pose;
    Preintegration felt;
  };
  // Holds a difference of what scans show and what the samples tell, and what it may be.
  struct Misfit {
    Vector3 error = Vector3::Zero();
    Matrix3 cov = Matrix3::Zero();             // by the noise of poses and samples
    double limit = 0.0;                        // by all else
    Vector3 seen = Vector3::Zero();            // the scans show this alone, rad/s or m/s^2
    Matrix3 R_imu_axes = Matrix3::Identity();  // from the axes of these vectors to imu

    // The error along the direction, in the size that it may have.
    [[nodiscard]] double Excess(const Vector3& direction) const;
  };
  using Runs = std::span<const ImuAgreementParameters::Run>;
  std::optional<ImuContradiction> FindIn(ImuSensor sensor, std::size_t span, const Belief& belief,
                                         Runs runs = kImuAgreement.runs) const;
  static std::optional<Vector3> CommonDirection(std::span<const Misfit> misfits, double min_mean);
  Misfit MisfitOf(ImuSensor sensor, std::size_t end, std::size_t span, const Belief& belief) const;
  Misfit TurnMisfit(std::size_t end, std::size_t span, const Belief& belief) const;
  Misfit BendMisfit(std::size_t end, std::size_t span, const Belief& belief) const;
  Preintegration FeltBetween(std::size_t begin, std::size_t end) const;
  const MatchedPose& pose(std::size_t i) const { return poses_[i].pose; }

  std::deque<Entry> poses_;
};

struct ModeContext;

// The context tells all that is not the mode's own.
[[nodiscard]] ImuAgreement::Belief BeliefAbout(const Biases& biases, const ImuNoise& noise,
                                               const Vector3& g_map, const ModeContext& context);

}  // namespace lio
