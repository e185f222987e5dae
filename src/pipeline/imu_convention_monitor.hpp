// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Watches whether the inertial messages mean what is believed: their units, axes and gravity. The
// evidence is gathered from matched poses and samples by ImuClassifier, across changes of mode,
// until it is beyond doubt.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/imu/imu_classifier.hpp"
#include "lio/stream/imu_buffer.hpp"

namespace lio {

// These tell a wrong convention from a bad second; docs/experiments/imu_convention.md has what they
// lead to.
struct ConventionMonitorParameters {
  // Fewer scans say nothing about whether the gyro misleads the constant-velocity tracker.
  std::size_t min_scans = ImuClassifierParameters{}.min_steps;
  // While tracking, so many poses lie between two verdicts. Chosen: half a second at 10 Hz, for the
  // time of a verdict.
  int poses_per_verdict = 5;
  // A gyro that reads this much over half a second while nothing is matched has other units.
  // Chosen: no vehicle turns by a radian a second for long; hands do, but their scans match.
  int wild_after_unmatched = 5;
  Duration wild_span{500'000'000};
  double wild_rate_radps = 1.0;
  // Two of the last five scans beyond the gate make another convention likely. Chosen: one may be a
  // wrong match.
  int max_gated_lately = 2;
  // s. Without turns a doubt cannot be settled: then the start goes on after this long. Chosen: the
  // time over which evidence is kept (MotionEvidenceParameters::max_steps).
  double max_doubt_s = 10.0;
};

inline constexpr ConventionMonitorParameters kConventionMonitor;

class ImuConventionMonitor {
 public:
  // Both outlive this.
  ImuConventionMonitor(const Rig& rig, const ImuBuffer& imu);

  // The poses to come are in another map, and tell anew of the time from `from` on.
  void BeginMap(Timestamp from) { classifier_.BeginMap(from); }
  void AddPose(const StampedPose& T_map_imu);
  // The convention has changed, or all evidence was gathered with useless rates.
  void Restart();
  // The next doubt counts as the first one.
  void ForgetDoubt() { has_doubted_ = false; }

  // Holds the coarse track of an initialization: how many scans it has and how many of them are
  // matched, and the samples since its first sweep.
  struct TrackFacts {
    std::size_t num_scans = 0;
    std::size_t num_matched = 0;
    std::span<const ImuSample> samples;
  };
  struct Finding {
    enum class Kind {
      kNone,
      kMisleadingGyro,  // the gyro misled tracking: its track is of no use
      kOtherwise        // the samples are in `convention`
    };
    Kind kind = Kind::kNone;
    ImuConvention convention;
    std::string evidence;
  };
  [[nodiscard]] Finding JudgeInitializing(const TrackFacts& facts, bool is_in_doubt);

  struct TrackingFacts {
    Timestamp stamp;
    int num_unmatched_in_a_row = 0;
    int num_gated_lately = 0;
    Vector3 gyro_bias_radps = Vector3::Zero();
  };
  // True: matching and IMU contradict each other, and the start must begin anew to find out why.
  [[nodiscard]] bool IsContradicted(const TrackingFacts& facts);

  // A start since then would be wrong again as long as the doubt that ended it is not settled.
  [[nodiscard]] bool IsInDoubt(Timestamp last_fix, Timestamp now) const;

  // Returns what the messages rather seem to mean while a doubt is not settled; absent otherwise.
  [[nodiscard]] std::optional<ImuConvention> Suspected() const;

  // A mean force over a rest tells this of the convention under which it was read.
  struct ForceVerdict {
    ForceAtRest force = ForceAtRest::kUnclear;
    ImuConvention convention;  // the convention that the force tells
    std::string evidence;
  };
  [[nodiscard]] ForceVerdict JudgeForce(const Vector3& mean_f_mps2) const;
  // The force at rest has told the unit: motion that looks otherwise is not believed.
  void KeepForceUnit();
  // Do rates over a rest have the noise that this gyro has in deg/s?
  [[nodiscard]] bool MayBeDegrees(std::span<const ImuSample> samples) const;
  // Is gravity in the forces of a drive, whose mean is given? It is absent where that is not clear.
  [[nodiscard]] std::optional<bool> GravityInMotion(const Vector3& mean_f_mps2) const;

  // May the gyro's rates serve the constant-velocity tracker?
  bool trusts_gyro() const { return trusts_gyro_; }
  // Is it beyond doubt what the messages mean?
  bool is_settled() const { return is_settled_; }
  void TrustGyro(bool trusts) { trusts_gyro_ = trusts; }

 private:
  bool IsGyroMisleading(const ImuVerdict& verdict, const TrackFacts& facts) const;
  bool IsGyroWild(const TrackingFacts& facts) const;
  bool IsDoubtful(const TrackingFacts& facts) const;

  const Rig* rig_;
  const ImuBuffer* imu_;
  ImuClassifier classifier_;
  bool is_settled_ = false;          // beyond doubt
  bool is_force_unit_told_ = false;  // by gravity, at rest
  bool has_doubted_ = false;         // a start was given up under this convention
  bool trusts_gyro_ = true;
  std::optional<bool> has_gravity_in_motion_;
  Timestamp classified_until_;
  int num_poses_to_judge_ = 0;
};

}  // namespace lio
