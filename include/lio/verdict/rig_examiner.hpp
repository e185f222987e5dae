// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Watches a run and judges it: gathers the motion as lidar and IMU show it (rig_findings.hpp) and
// how much of the run has poses (run_tally.hpp). It only looks on: no estimate depends on it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/verdict/motion_record.hpp"
#include "lio/verdict/run_tally.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct RigExaminerParameters {
  // Coverage below which a result is doubtful, and of no use. Chosen: what is missing for a tenth
  // of the time was an outage; with half of it missing the path is a guess.
  double doubtful_coverage = 0.9;
  double least_coverage = 0.5;
  // s. The rig is looked at so long after the first pose, and again after each doubling: a look
  // costs some ten milliseconds. Chosen: the first turn of a street.
  double first_look_s = 15.0;
};

inline constexpr RigExaminerParameters kRigExaminer;

class RigExaminer {
 public:
  // `rig` is borrowed.
  RigExaminer(const Rig& rig, bool uses_imu);

  MotionRecord& record() { return record_; }
  RunTally& tally() { return tally_; }
  // From here on the messages are read in other units or axes.
  void SetConvention(const ImuConvention& convention);
  // The run ends, because the configuration contradicts the data.
  void Contradict(std::vector<Cause> causes) { contradictions_ = std::move(causes); }

  // To be called for each scan with a pose: tells once when it is sure that the rig is wrong.
  [[nodiscard]] std::optional<std::string> News(Timestamp stamp);
  [[nodiscard]] Verdict Judge(const Counters& counters) const;
  // The trust that was left at the last look.
  [[nodiscard]] Trust trust() const { return trust_; }

 private:
  const Rig& rig_;
  bool uses_imu_;
  ImuConvention convention_;
  MotionRecord record_;
  RunTally tally_;
  std::vector<Cause> contradictions_;
  std::optional<Timestamp> first_stamp_;
  double next_look_s_ = kRigExaminer.first_look_s;
  bool has_told_ = false;
  Trust trust_ = Trust::kYes;
};

}  // namespace lio
