// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds out what the numbers of the inertial messages mean: g or m/s^2, deg/s or rad/s, with or
// without gravity, and whether the axes are turned by quarter turns against what the rig says.
//
// Does: scores each of the 192 ways of reading the samples (24 turns of the axes, 2 units of rates,
// 2 of forces, gravity or none) against poses from scan matching, see motion_evidence.hpp. Scores
// are in units of chi-square, scaled so that the best reading fits.
// Verdict: a reading other than the expected one is found only when the expected one is far worse
// and no other does nearly as well; of several that do, the one counts that differs from the
// expected in the fewest points, if there is only one. Rest and straight roads leave it open,
// and so does what clocks explain that are off by up to two sweeps.
// Not told apart: forces without gravity in g from those in m/s^2, unless the drive is lively.
// Cost: about 0.3 ms a verdict over 10 s at 10 Hz.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/imu/motion_evidence.hpp"

namespace lio {

struct ImuVerdict {
  enum class Finding {
    kOpen,         // the motion so far does not say
    kAsExpected,   // and no other reading fits
    kNotExpected,  // the expected one does not fit, several others do
    kOtherwise     // `reading` fits, the expected one does not
  };
  Finding finding = Finding::kOpen;
  ImuConvention reading;            // the expected one, or what was found instead
  std::optional<bool> has_gravity;  // in the accelerometer's reading; absent while unclear
  std::string evidence;             // for people; kOtherwise only
};

class ImuClassifier {
 public:
  ImuClassifier(const ImuConvention& expected, const Rig& rig);

  // It was told at rest: forces that scan matching does not see are no other unit's.
  void KeepForceUnit() { keeps_force_unit_ = true; }

  // The poses to come are in another map, and tell anew of the time from `from` on.
  void BeginMap(Timestamp from) { evidence_.BeginMap(from); }
  // A matched pose, later than the one before, and the samples since that, as sent.
  void AddPose(const StampedPose& T_map_imu, std::span<const ImuSample> sent) {
    evidence_.AddPose(T_map_imu, sent);
  }

  // `in_doubt`: something else speaks against the expected reading too, so it is given up sooner.
  ImuVerdict Judge(bool in_doubt = false) const;

  // While the body moved, lately, the rates as expected have been many times what scan matching
  // saw: whatever is wrong, they are of no help to it.
  bool IsGyroAbsurd() const;
  // Another reading fits a little better. Where the poses are wrong and not the reading, as when a
  // scan clings to the rings of a standstill, none does.
  bool FavoursAnother() const;
  bool HasMoved() const { return evidence_.HasMoved(); }

 private:
  using Bends = std::span<const MotionEvidence::Bend>;
  struct Scored {
    ImuConvention reading;
    bool has_gravity = false;
    double score = 0.0;
  };

  struct Ranking {
    std::vector<Scored> all;
    double best = std::numeric_limits<double>::infinity();
    double expected = std::numeric_limits<double>::infinity();
    double scale = 1.0;  // that makes the best one fit
  };

  Ranking Rank(Bends bends) const;
  std::vector<Scored> ScoreAll(Bends bends) const;
  void ScoreForces(const ImuConvention& rates, Bends bends, std::vector<Scored>& all) const;
  std::optional<ImuConvention> LeastChange(std::span<const Scored> likely) const;
  bool IsGyroHeard(const ImuConvention& reading) const;
  double ExpectedScoreOfOtherClocks() const;
  double Lean(const ImuConvention& reading) const;
  std::string Describe(const ImuConvention& found, Bends bends) const;

  ImuConvention expected_;
  bool keeps_force_unit_ = false;
  double gravity_mps2_;
  Vector3 lidar_axis_imu_;  // up, where the lidar stands
  MotionEvidence evidence_;
};

// What a mean specific force, as sent, can only be when the vehicle stands still.
enum class ForceAtRest { kMetric, kInG, kWithoutGravity, kUnclear };
ForceAtRest JudgeForceAtRest(const Vector3& mean_f_sent, double gravity_mps2);

// The noise of rates [rad/s], whatever the motion: by their second differences, the worst axis'.
double RateNoise(std::span<const ImuSample> samples);
// Samples in rad/s whose noise only fits what the rig says of the gyro when they are in deg/s.
bool IsNoiseOfDegrees(std::span<const ImuSample> samples, const ImuRig& imu);

}  // namespace lio
