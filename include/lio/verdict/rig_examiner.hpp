// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Watches a run and judges it: gathers the motion as lidar and IMU show it (rig_findings.hpp) and
// how much of the run has poses (run_tally.hpp).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/verdict/motion_record.hpp"
#include "lio/verdict/rig_findings.hpp"
#include "lio/verdict/run_tally.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct RigExaminerParameters {
  // Coverage below which a result is doubtful, and of no use. Chosen: what is missing for a tenth
  // of the time was an outage; with half of it missing the path is a guess.
  double doubtful_coverage = 0.9;
  double least_coverage = 0.5;
  // m per 100 m (1 sigma). A result whose own covariance claims more is doubtful. Chosen: several
  // times the 1 to 2 % that a vehicle's wheels drift.
  double doubtful_claim_m = 5.0;
  // s. The rig is looked at so long after the first pose, and again each time the drive is longer
  // by this factor: a look costs some ten milliseconds. Chosen: a walker has then shown an
  // extrinsic that is off by degrees.
  double first_look_s = 7.5;
  double next_look_factor = 1.25;
};

inline constexpr RigExaminerParameters kRigExaminer;

class RigExaminer {
 public:
  // `is_lever_found`: as in FindRigErrors.
  RigExaminer(const Rig& rig, bool uses_imu, bool is_lever_found = false);

  MotionRecord& record() { return record_; }
  RunTally& tally() { return tally_; }
  // From here on the messages are read in other units or axes.
  void SetConvention(const ImuConvention& convention);
  // The run ends, because the configuration contradicts the data.
  void Contradict(std::vector<Cause> causes) { contradictions_ = std::move(causes); }

  // To be called for each scan with a pose: looks at the rig now and then.
  [[nodiscard]] std::optional<RigFindings> Look(Timestamp stamp);
  // Tells once when a look is sure that the result cannot be trusted. Judge() then keeps the cause,
  // even if later looks see too little to find it again, until rig or convention change.
  [[nodiscard]] std::optional<std::string> News(const RigFindings& findings);
  // The extrinsic is another one from here on, since a look has found the rig's wrong, or has
  // bettered what an earlier one found. T_old_new: MotionRecord::SetImu.
  void SetExtrinsic(const RigFindings& findings, const Pose& T_imu_lidar, const Pose& T_old_new);
  // `suspected`: causes that the run has made likely without being sure.
  [[nodiscard]] Verdict Judge(const Counters& counters, std::vector<Cause> suspected = {}) const;
  // The trust that was left at the last look.
  [[nodiscard]] Trust trust() const { return trust_; }
  // Those of the last look; nothing before the first, and after the rig was changed.
  [[nodiscard]] const std::optional<RigBounds>& bounds() const { return bounds_; }

 private:
  Rig rig_;  // as it is in use
  bool uses_imu_;
  bool is_lever_found_;
  ImuConvention convention_;
  MotionRecord record_;
  RunTally tally_;
  std::vector<Cause> contradictions_;
  std::vector<Cause> corrected_;  // causes that are no longer there
  std::optional<Timestamp> first_stamp_;
  std::optional<Timestamp> last_stamp_;
  double next_look_s_ = kRigExaminer.first_look_s;
  std::optional<Cause> told_;  // reason for distrust that was told on the way
  Trust trust_ = Trust::kYes;
  std::optional<RigBounds> bounds_;
};

}  // namespace lio
