// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking corrects a wrong extrinsic.
#include <fmt/format.h>

#include <algorithm>

#include "lio/filter/extrinsic_correction.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "pipeline/tracking.hpp"

namespace lio {
namespace {

std::string TextFor(const RigFindings& findings, const Pose& T_imu_lidar) {
  if (!findings.T_imu_lidar) {
    const Vector3& lever = T_imu_lidar.translation;
    return fmt::format("the extrinsic is refined: its translation is [{:.3f}, {:.3f}, {:.3f}] m",
                       lever.x(), lever.y(), lever.z());
  }
  const auto cause = std::ranges::find_if(findings.causes, IsOfExtrinsic);
  return fmt::format("the extrinsic is corrected from here on, poses before are doubtful: {}",
                     cause->evidence);
}

}  // namespace

// The lidar's place must be known. A wrong extrinsic has matches gated, so the filter's may not.
void Tracking::LookAtRig(Timestamp end) {
  if (health_.num_unmatched_in_a_row() > 0 || outage_.is_running()) return;
  const auto findings = context_.examiner.Look(end);
  if (!findings) return;
  if (const auto T_old_new = context_.extrinsic.Take(*findings)) {
    context_.examiner.SetExtrinsic(*findings, context_.extrinsic.T_imu_lidar(), *T_old_new);
    CorrectExtrinsicBy(*T_old_new, end);
    context_.outputs.Notify(end, Notice::Severity::kWarning,
                            TextFor(*findings, context_.extrinsic.T_imu_lidar()));
  } else if (const auto news = context_.examiner.News(*findings)) {
    context_.outputs.Notify(end, Notice::Severity::kWarning, *news);
  }
}

void Tracking::CorrectExtrinsicBy(const Pose& T_old_new, Timestamp end) {
  const ImuRig& rig = context_.options.rig.imu;
  const ImuSample sample = SampleAt(context_.stream.imu().samples(), end);
  Estimate estimate = history_.At(end);
  CorrectExtrinsic(T_old_new, sample.w_imu_radps - estimate.state.gyro_bias,
                   {rig.gyro_bias_std_radps, rig.accel_bias_std_mps2}, estimate);
  BeginHistoryAt(estimate);
  context_.sensor_errors.SetImu(T_old_new);
  ForgetPoses(end);
}

}  // namespace lio
