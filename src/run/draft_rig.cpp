// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "draft_rig.hpp"

#include <fmt/format.h>

#include "lio/io/output_file.hpp"

namespace lio {
namespace {

std::string AboutLidar(const SensorFacts& facts, const SourceKnowledge& known) {
  return fmt::format("Lidar {}: {:.2f} Hz, {}", known.lidar_name, facts.lidar.rate_hz(),
                     facts.num_rings > 0 ? fmt::format("{} rings", facts.num_rings) : "no rings");
}

std::string AboutImu(const SensorFacts& facts, const SourceKnowledge& known) {
  return fmt::format(
      "IMU {}: {:.1f} Hz, mean |accel| {:.3f} in its quietest second, largest |gyro| {:.2f}",
      known.imu_name, facts.imu.rate_hz(), facts.accelerometer.quiet_mean_mps2(),
      facts.accelerometer.largest_rate_radps());
}

// Which unit and gravity the samples show: `auto` finds the same, so this is for the reader.
std::string UnitsSeen(const AccelerometerStats& accelerometer) {
  const double quiet = accelerometer.quiet_mean_mps2();
  const bool is_deg = accelerometer.largest_rate_radps() > 35.0;
  std::string force = "neither m/s^2 nor g is plain from the quietest second";
  if (quiet > 9.0 && quiet < 10.6) force = "m/s^2";
  if (quiet > 0.92 && quiet < 1.08) force = "g";
  return fmt::format("The samples look like {} and {}; auto finds out from the first motion.",
                     force, is_deg ? "deg/s" : "rad/s");
}

std::string GravitySeen(const AccelerometerStats& accelerometer) {
  return accelerometer.quiet_mean_mps2() < 0.6
             ? "Gravity seems to be removed from the samples; auto finds out."
             : "Gravity seems to be part of the samples; auto finds out.";
}

void FillUnknownRig(const SensorFacts& facts, const SourceKnowledge& known, RigDraft& draft) {
  draft.rig.lidar.model = facts.guess.model;
  draft.lidar_reason = "Model: " + facts.guess.reason + ".";
  draft.units_reason = UnitsSeen(facts.accelerometer);
  draft.gravity_reason = GravitySeen(facts.accelerometer);
  draft.noise_reason =
      "A good MEMS sensor on a vehicle; the filter learns more noise than this by itself.";
  draft.extrinsic_reason = known.extrinsic_reason;
  if (draft.use_imu) draft.rig.T_imu_lidar = known.T_imu_lidar.value_or(Pose::Identity());
}

void FillKnownRig(const SourceKnowledge& known, RigDraft& draft) {
  draft.rig = *known.rig;
  for (std::string* reason : {&draft.extrinsic_reason, &draft.lidar_reason, &draft.units_reason,
                              &draft.gravity_reason, &draft.noise_reason}) {
    *reason = known.rig_reason;
  }
}

void AddAssumptions(const SensorFacts& facts, const SourceKnowledge& known, const RigDraft& draft,
                    PreparedRecording& prepared) {
  std::vector<std::string>& said = prepared.assumptions;
  if (known.rig) {
    said.push_back("The rig: " + known.rig_reason);
    return;
  }
  said.push_back(fmt::format("Lidar model {}: {}.", draft.rig.lidar.model, facts.guess.reason));
  if (!draft.use_imu) {
    said.push_back("There are no inertial samples: odometry is by the lidar alone.");
    return;
  }
  said.push_back("Extrinsic: " + known.extrinsic_reason);
  said.push_back(draft.units_reason + " " + draft.gravity_reason);
}

std::string CommandFor(const RecordingRequest& request, const std::string& draft_file) {
  return fmt::format("lio-run {} --rig {} --out {} --overwrite", request.input.string(), draft_file,
                     request.out.string());
}

}  // namespace

void WriteRigDraft(const RecordingRequest& request, const SourceKnowledge& known,
                   PreparedRecording& prepared) {
  const SensorFacts facts = LookAtLog(prepared.log);
  const std::filesystem::path file = request.out / "rig_draft.yaml";
  RigDraft draft;
  draft.input = request.input.string();
  draft.command = CommandFor(request, file.string());
  draft.use_imu = facts.imu.num() > 0 && !known.never_uses_imu;
  draft.about.push_back(AboutLidar(facts, known));
  if (facts.imu.num() > 0) draft.about.push_back(AboutImu(facts, known));
  if (known.rig) {
    FillKnownRig(known, draft);
  } else {
    FillUnknownRig(facts, known, draft);
  }
  WriteText(file, RigDraftYaml(draft));
  prepared.rig_files = {file};
  AddAssumptions(facts, known, draft, prepared);
}

}  // namespace lio
