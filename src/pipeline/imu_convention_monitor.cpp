// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_convention_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lio {
namespace {

bool HasSameRates(const ImuConvention& a, const ImuConvention& b) {
  return a.is_in_deg == b.is_in_deg && a.R_imu_sent == b.R_imu_sent;
}

}  // namespace

ImuConventionMonitor::ImuConventionMonitor(const Rig& rig, const ImuBuffer& imu)
    : rig_(&rig), imu_(&imu), classifier_(imu.convention(), rig) {}

void ImuConventionMonitor::AddPose(const StampedPose& T_map_imu) {
  if (is_settled_) return;
  const Timestamp since = std::exchange(classified_until_, T_map_imu.stamp);
  std::vector<ImuSample> sent;
  for (const ImuSample& sample : imu_->sent()) {
    if (sample.stamp >= since && sample.stamp <= T_map_imu.stamp) sent.push_back(sample);
  }
  classifier_.AddPose(T_map_imu, sent);
  ++num_poses_to_judge_;
}

void ImuConventionMonitor::Restart() {
  classifier_ = ImuClassifier(imu_->convention(), *rig_);
  if (is_force_unit_told_) classifier_.KeepForceUnit();
}

ImuConventionMonitor::Finding ImuConventionMonitor::JudgeInitializing(const TrackFacts& facts,
                                                                      bool is_in_doubt) {
  if (is_settled_) return {};
  const ImuVerdict verdict = classifier_.Judge(is_in_doubt);
  has_gravity_in_motion_ = verdict.has_gravity;
  if (trusts_gyro_ && IsGyroMisleading(verdict, facts)) {
    Restart();
    trusts_gyro_ = false;
    return {Finding::Kind::kMisleadingGyro, {}, {}};
  }
  is_settled_ = verdict.finding == ImuVerdict::Finding::kAsExpected;
  if (verdict.finding != ImuVerdict::Finding::kOtherwise) return {};
  return {Finding::Kind::kOtherwise, verdict.convention, verdict.evidence};
}

// The poses that the verdict is about were tracked with this gyro's rates, so that wrong rates
// spoil them.
bool ImuConventionMonitor::IsGyroMisleading(const ImuVerdict& verdict,
                                            const TrackFacts& facts) const {
  if (verdict.finding == ImuVerdict::Finding::kOtherwise) {
    return !HasSameRates(verdict.convention, imu_->convention());
  }
  const bool few_are_matched =
      facts.num_scans >= kConventionMonitor.min_scans && 2 * facts.num_matched < facts.num_scans;
  return verdict.finding == ImuVerdict::Finding::kNotExpected || few_are_matched ||
         classifier_.IsGyroAbsurd() || MayBeDegrees(facts.samples);
}

// A start at rest tells nothing of the rates: the first turns do.
bool ImuConventionMonitor::IsContradicted(const TrackingFacts& facts) {
  if (is_settled_) return false;
  const bool is_wild = IsGyroWild(facts);
  const bool is_doubtful = IsDoubtful(facts);
  if (num_poses_to_judge_ < kConventionMonitor.poses_per_verdict && !is_wild && !is_doubtful) {
    return false;
  }
  num_poses_to_judge_ = 0;
  const ImuVerdict::Finding finding = classifier_.Judge().finding;
  is_settled_ = finding == ImuVerdict::Finding::kAsExpected;
  const bool is_unfit = classifier_.HasMoved() && (finding == ImuVerdict::Finding::kNotExpected ||
                                                   finding == ImuVerdict::Finding::kOtherwise);
  const bool is_useless = is_wild || classifier_.IsGyroAbsurd();
  if (is_settled_ || !(is_useless || is_unfit || is_doubtful)) return false;
  has_doubted_ = true;
  if (is_useless) Restart();
  trusts_gyro_ = false;
  return true;
}

// The filter is sure of itself and refuses what scan matching measured, as it does soon after
// driving off under a wrong convention. It counts once, for there may be other reasons.
bool ImuConventionMonitor::IsDoubtful(const TrackingFacts& facts) const {
  return !has_doubted_ && facts.num_gated_lately >= kConventionMonitor.max_gated_lately &&
         classifier_.FavoursAnother();
}

// Nothing is matched any more, and the gyro reads more than a vehicle's turns. One at the end of
// its range does so rightly, and misses a part of the motion.
bool ImuConventionMonitor::IsGyroWild(const TrackingFacts& facts) const {
  if (facts.num_unmatched_in_a_row < kConventionMonitor.wild_after_unmatched) return false;
  const std::vector<ImuSample> samples =
      imu_->Between(facts.stamp - kConventionMonitor.wild_span, facts.stamp);
  if (std::ranges::any_of(samples, &ImuSample::is_saturated)) return false;
  double sum_sq = 0.0;
  for (const ImuSample& sample : samples) {
    sum_sq += (sample.w_imu_radps - facts.gyro_bias_radps).squaredNorm();
  }
  return sum_sq > kConventionMonitor.wild_rate_radps * kConventionMonitor.wild_rate_radps *
                      static_cast<double>(samples.size());
}

bool ImuConventionMonitor::IsInDoubt(Timestamp last_fix, Timestamp now) const {
  return !is_settled_ && has_doubted_ &&
         SecondsBetween(last_fix, now) < kConventionMonitor.max_doubt_s;
}

std::optional<ImuConvention> ImuConventionMonitor::Suspected() const {
  return has_doubted_ && !is_settled_ ? classifier_.Favoured() : std::nullopt;
}

ImuConventionMonitor::ForceVerdict ImuConventionMonitor::JudgeForce(
    const Vector3& mean_f_mps2) const {
  ImuSample mean;
  mean.f_imu_mps2 = mean_f_mps2;
  const ImuConvention& believed = imu_->convention();
  const Vector3 sent = FromSi(believed, mean).f_imu_mps2;
  ForceVerdict verdict{JudgeForceAtRest(sent, rig_->gravity_mps2), believed,
                       fmt::format("at rest the accelerometer reads {:.2f}", sent.norm())};
  if (verdict.force == ForceAtRest::kMetric) verdict.convention.is_in_g = false;
  if (verdict.force == ForceAtRest::kInG) verdict.convention.is_in_g = true;
  return verdict;
}

void ImuConventionMonitor::KeepForceUnit() {
  is_force_unit_told_ = true;
  classifier_.KeepForceUnit();
}

bool ImuConventionMonitor::MayBeDegrees(std::span<const ImuSample> samples) const {
  return rig_->imu.units == ImuUnits::kAutomatic && !imu_->convention().is_in_deg &&
         IsNoiseOfDegrees(samples, rig_->imu);
}

std::optional<bool> ImuConventionMonitor::GravityInMotion(const Vector3& mean_f_mps2) const {
  if (mean_f_mps2.norm() > 0.5 * rig_->gravity_mps2) return true;
  if (has_gravity_in_motion_.has_value() && !*has_gravity_in_motion_) return false;
  return std::nullopt;
}

}  // namespace lio
