// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Detects the IMU convention: whether the inertial messages are in g or m/s^2, in deg/s or rad/s,
// with or without gravity, and whether their axes are turned by quarter turns against the rig's.
//
// Does: scores each of the 192 conventions (24 turns of the axes, 2 units of rates, 2 of forces,
// gravity or none) against poses from scan matching; motion_evidence.hpp has the scores, which are
// chi-squares. They are scaled so that the best convention fits. Verdict: the expected convention
// is given up only when it is far worse than the best; another is found only when no other does
// nearly as well. When several do, the one that differs from the expected in the fewest points is
// taken, if there is only one. Rest and straight roads decide nothing, and nothing is decided that
// a clock offset of up to two sweeps would explain as well. Limits: forces without gravity in g
// cannot be told from those in m/s^2 unless the drive is lively. A verdict over 10 s at 10 Hz costs
// about 0.3 ms. Nothing throws. Constants: imu_convention_parameters.hpp; the method:
// docs/filter.md.
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
    kOpen,         // the motion so far decides nothing
    kAsExpected,   // the expected convention fits and no other does
    kNotExpected,  // the expected convention does not fit, several others do
    kOtherwise     // `convention` fits, the expected one does not
  };
  Finding finding = Finding::kOpen;
  ImuConvention convention;         // the expected one, or the one that was found
  std::optional<bool> has_gravity;  // in the measured specific force; absent while undecided
  std::string evidence;             // for messages to users; under kOtherwise only
};

class ImuClassifier {
 public:
  ImuClassifier(const ImuConvention& expected, const Rig& rig);

  // The unit of forces is known from rest, so motion that scan matching misses cannot change it.
  void KeepForceUnit() { keeps_force_unit_ = true; }

  // Poses to come are in another map; evidence after `from` is discarded.
  void BeginMap(Timestamp from) { evidence_.BeginMap(from); }
  // Adds a matched pose, later than the one before, and the samples since that pose, as sent.
  void AddPose(const StampedPose& T_map_imu, std::span<const ImuSample> sent) {
    evidence_.AddPose(T_map_imu, sent);
  }

  // `in_doubt`: other evidence contradicts the expected convention, too, so it is given up sooner.
  [[nodiscard]] ImuVerdict Judge(bool in_doubt = false) const;

  // Returns true when the body moves and the rates under the expected convention were lately many
  // times those of scan matching: such a gyro only misleads the motion prior.
  bool IsGyroAbsurd() const;
  // Returns true when another convention fits slightly better. When the poses are wrong rather than
  // the convention, as when scans hold to the rings of a standstill, no other fits better.
  bool FavoursAnother() const;
  // Returns that one: among those that fit nearly as well as the best, the one that differs from
  // the expected in the fewest points. Absent where several do, or where none fits better.
  [[nodiscard]] std::optional<ImuConvention> Favoured() const;
  bool HasMoved() const { return evidence_.HasMoved(); }

 private:
  using Bends = std::span<const MotionEvidence::Bend>;
  struct Scored {
    ImuConvention convention;
    bool has_gravity = false;
    double score = 0.0;
  };

  struct Ranking {
    std::vector<Scored> all;
    double best = std::numeric_limits<double>::infinity();
    double expected = std::numeric_limits<double>::infinity();
    double scale = 1.0;  // chi-square per degree of freedom of the best one, at least 1
  };

  Ranking Rank(Bends bends) const;
  std::vector<Scored> FavouredOverExpected() const;
  std::vector<Scored> ScoreAll(Bends bends) const;
  void ScoreForces(const ImuConvention& rates, Bends bends, std::vector<Scored>& all) const;
  std::optional<ImuConvention> LeastChange(std::span<const Scored> likely) const;
  bool IsGyroHeard(const ImuConvention& convention) const;
  double ExpectedScoreOfOtherClocks() const;
  double Lean(const ImuConvention& convention) const;
  std::string Describe(const ImuConvention& found, Bends bends) const;

  ImuConvention expected_;
  bool keeps_force_unit_ = false;
  double gravity_mps2_;
  Vector3 lidar_axis_imu_;  // the lidar's z axis: up when the lidar stands upright
  MotionEvidence evidence_;
};

// The convention of the forces that the mean specific force of a body at rest, as sent, allows.
enum class ForceAtRest { kMetric, kInG, kWithoutGravity, kUnclear };
ForceAtRest JudgeForceAtRest(const Vector3& mean_f_sent, double gravity_mps2);

// Returns the standard deviation of the rates' noise [rad/s] on the noisiest axis, from their
// second differences: independent of the motion while it is smooth over three samples. 0 below
// three.
double RateNoise(std::span<const ImuSample> samples);
// Returns true for samples, taken as rad/s, whose noise agrees with the rig's gyro only if they are
// in deg/s.
bool IsNoiseOfDegrees(std::span<const ImuSample> samples, const ImuRig& imu);

}  // namespace lio
