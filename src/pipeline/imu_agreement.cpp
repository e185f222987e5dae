// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/sensor/gap.hpp"
#include "lio/verdict/motion_record.hpp"
#include "pipeline/mode_context.hpp"
#include "pipeline/unseen_motion.hpp"

namespace lio {
namespace {

Preintegration Joined(const Preintegration& a, const Preintegration& b) {
  Preintegration joined;
  joined.from = a.from;
  joined.to = b.to;
  joined.rotation = a.rotation * b.rotation;
  joined.velocity = a.velocity + a.rotation * b.velocity;
  joined.position = a.position + b.span_s() * a.velocity + a.rotation * b.position;
  return joined;
}

Matrix3 Turned(const Matrix3& R, const Matrix3& cov) {
  return R * cov * R.transpose();
}

Matrix3 PositionCovInMap(const ImuAgreement::MatchedPose& pose) {
  return Turned(pose.T_map_imu.rotation.toRotationMatrix(), pose.cov.topLeftCorner<3, 3>());
}

Vector3 MeanRate(const Preintegration& felt) {
  return LogSo3(felt.rotation) / felt.span_s();
}

}  // namespace

std::vector<ImuSample> SamplesAbout(const ImuBuffer& imu, Timestamp from, Timestamp to) {
  const Duration margin = Duration::FromSeconds(kMotionRecord.instant_s);
  return imu.Between(from - margin, to + margin);
}

ImuContradiction ContradictionOf(const StuckImuDetector::Stuck& stuck, Timestamp since) {
  const bool is_gyro = stuck.sensor == ImuSensor::kGyro;
  return {.sensor = stuck.sensor,
          .since = since,
          .axis_imu = stuck.axis_imu,
          .evidence = is_gyro ? "an axis of the gyro reads the same all the time"
                              : "an axis of the accelerometer reads the same all the time"};
}

ImuAgreement::Belief BeliefAbout(const Biases& biases, const ImuNoise& noise, const Vector3& g_map,
                                 const ModeContext& context) {
  const ImuRig& rig = context.options.rig.imu;
  return {.biases = biases,
          .noise = noise,
          .g_map = g_map,
          .gyro_bias_std_radps = rig.gyro_bias_std_radps,
          .accel_bias_std_mps2 = rig.accel_bias_std_mps2,
          .rig = context.examiner.bounds(),
          .clock_error_s = context.clocks.error_s()};
}

double ImuAgreement::Belief::rotation_error_rad() const {
  constexpr double kMost = kImuAgreement.rotation_error_rad;
  return rig ? std::min(kMost, rig->rotation_rad.norm()) : kMost;
}

double ImuAgreement::Belief::lever_error_m() const {
  constexpr double kMost = kImuAgreement.lever_error_m;
  return rig ? std::min(kMost, rig->lever_m.norm()) : kMost;
}

void ImuAgreement::Add(const MatchedPose& pose, std::span<const ImuSample> samples,
                       const Belief& belief) {
  const bool goes_on = !poses_.empty() && !samples.empty() && pose.stamp > *last() &&
                       pose.stamp - *last() <= kScanGap.unrelated;
  if (!goes_on) {
    poses_.clear();
    poses_.push_back({.pose = pose, .felt = {}});
    return;
  }
  poses_.push_back(
      {.pose = pose, .felt = Preintegrate(samples, *last(), pose.stamp, belief.biases, {})});
  if (poses_.size() > kImuAgreement.max_poses) poses_.pop_front();
}

void ImuAgreement::Add(const MatchedPose& pose, const ImuBuffer& imu, const Belief& belief) {
  std::vector<ImuSample> samples = SamplesAbout(imu, last().value_or(pose.stamp), pose.stamp);
  if (IsMotionHidden(samples)) samples.clear();
  Add(pose, samples, belief);
}

std::optional<Timestamp> ImuAgreement::last() const {
  return poses_.empty() ? std::nullopt : std::optional(poses_.back().pose.stamp);
}

Preintegration ImuAgreement::FeltBetween(std::size_t begin, std::size_t end) const {
  Preintegration sum = poses_[begin + 1].felt;
  for (std::size_t i = begin + 2; i <= end; ++i) sum = Joined(sum, poses_[i].felt);
  return sum;
}

double ImuAgreement::Misfit::Excess(const Vector3& direction) const {
  const double noise = kImuAgreement.sigmas * std::sqrt(direction.dot(cov * direction));
  return error.dot(direction) / (limit + noise);
}

// All is in the axes of imu at the end.
ImuAgreement::Misfit ImuAgreement::TurnMisfit(std::size_t end, std::size_t span,
                                              const Belief& belief) const {
  const std::size_t begin = end - span;
  const Preintegration felt = FeltBetween(begin, end);
  const double span_s = felt.span_s();
  const Quaternion seen = pose(begin).T_map_imu.rotation.conjugate() * pose(end).T_map_imu.rotation;
  const Vector3 turn_rad = LogSo3(seen);
  const double rate_radps =
      std::max(kImuAgreement.min_rate_radps, kImuAgreement.bias_stds * belief.gyro_bias_std_radps);
  // The samples of another clock tell the turn between two other instants.
  const double change_radps =
      (MeanRate(poses_[end].felt) - MeanRate(poses_[begin + 1].felt)).norm();
  Misfit misfit;
  misfit.error = LogSo3(felt.rotation.conjugate() * seen);
  misfit.cov =
      pose(end).cov.bottomRightCorner<3, 3>() +
      Turned(seen.conjugate().toRotationMatrix(), pose(begin).cov.bottomRightCorner<3, 3>()) +
      belief.noise.gyro_psd.maxCoeff() * span_s * Matrix3::Identity();
  misfit.limit = (kImuAgreement.scale_error + belief.rotation_error_rad()) * turn_rad.norm() +
                 rate_radps * span_s +
                 belief.clock_error_s.value_or(kImuAgreement.clock_error_s) * change_radps;
  misfit.seen = turn_rad / span_s;
  return misfit;
}

// All is in the axes of map. The first span is a, the second b:
//   p_1 = p_0 + v_0 t_a + g t_a^2/2 + R_0 dp_a,   v_1 = v_0 + g t_a + R_0 dv_a,
//   p_2 = p_1 + v_1 t_b + g t_b^2/2 + R_1 dp_b,   and v_0 drops out.
ImuAgreement::Misfit ImuAgreement::BendMisfit(std::size_t end, std::size_t span,
                                              const Belief& belief) const {
  const std::size_t middle = end - span;
  const std::size_t begin = middle - span;
  const Preintegration a = FeltBetween(begin, middle);
  const Preintegration b = FeltBetween(middle, end);
  const double ta_s = a.span_s();
  const double tb_s = b.span_s();
  const double ratio = tb_s / ta_s;
  const double bend_s2 = 0.5 * tb_s * (ta_s + tb_s);
  const auto second_difference = [&](const auto& at0, const auto& at1, const auto& at2) {
    return (at2 - at1 - ratio * (at1 - at0)).eval();
  };
  const auto rotation = [&](std::size_t i) -> Matrix3 {
    return pose(i).T_map_imu.rotation.toRotationMatrix();
  };
  const Matrix3 R0 = rotation(begin);
  const Matrix3 R1 = rotation(middle);
  const Vector3 seen =
      second_difference(pose(begin).T_map_imu.translation, pose(middle).T_map_imu.translation,
                        pose(end).T_map_imu.translation);
  // The samples of another clock tell the force of a moment before or after, in other axes.
  const double rate_radps = (LogSo3(a.rotation).norm() + LogSo3(b.rotation).norm()) / (ta_s + tb_s);
  const double jerk_mps3 =
      (R1 * b.velocity / tb_s - R0 * a.velocity / ta_s).norm() / (0.5 * (ta_s + tb_s));
  const double force_mps2 =
      std::max(kImuAgreement.min_force_mps2, kImuAgreement.bias_stds * belief.accel_bias_std_mps2) +
      belief.clock_error_s.value_or(kImuAgreement.clock_error_s) *
          (jerk_mps3 + rate_radps * belief.g_map.norm());
  Misfit misfit;
  misfit.error = seen - bend_s2 * belief.g_map - R0 * (tb_s * a.velocity - ratio * a.position) -
                 R1 * b.position;
  misfit.cov =
      PositionCovInMap(pose(end)) + (1.0 + ratio) * (1.0 + ratio) * PositionCovInMap(pose(middle)) +
      ratio * ratio * PositionCovInMap(pose(begin)) +
      belief.noise.accel_psd.maxCoeff() * (ta_s + tb_s) * tb_s * tb_s / 3.0 * Matrix3::Identity();
  misfit.limit = kImuAgreement.scale_error * seen.norm() + force_mps2 * bend_s2 +
                 belief.lever_error_m() * second_difference(R0, R1, rotation(end)).norm();
  misfit.seen = seen / bend_s2;
  misfit.R_imu_axes = rotation(end).transpose();
  return misfit;
}

ImuAgreement::Misfit ImuAgreement::MisfitOf(ImuSensor sensor, std::size_t end, std::size_t span,
                                            const Belief& belief) const {
  return sensor == ImuSensor::kGyro ? TurnMisfit(end, span, belief) : BendMisfit(end, span, belief);
}

// Returns the direction along which all the differences lie, if they are large enough.
std::optional<Vector3> ImuAgreement::CommonDirection(std::span<const Misfit> misfits,
                                                     double min_mean) {
  Vector3 sum = Vector3::Zero();
  for (const Misfit& misfit : misfits) sum += misfit.error;
  const Vector3 direction = sum.normalized();
  double mean_excess = 0.0;
  for (const Misfit& misfit : misfits) {
    const double excess = misfit.Excess(direction);
    if (!(excess > kImuAgreement.min_share)) return std::nullopt;
    mean_excess += excess / static_cast<double>(misfits.size());
  }
  if (mean_excess < min_mean) return std::nullopt;
  return direction;
}

std::optional<ImuContradiction> ImuAgreement::FindIn(ImuSensor sensor, std::size_t span,
                                                     const Belief& belief, Runs runs) const {
  const bool is_gyro = sensor == ImuSensor::kGyro;
  // Turns follow each other. Bends overlap, and end within a span and a half: a jump of the poses
  // bends the path one way for a span, and then the other way.
  const std::size_t step = is_gyro ? span : (span + 1) / 2;
  const std::size_t last = poses_.size() - 1;
  std::vector<Misfit> misfits;  // the newest first
  for (const ImuAgreementParameters::Run& run : runs) {
    const std::size_t num_poses_before = (is_gyro ? span : 2 * span) + (run.num - 1) * step;
    if (last < num_poses_before) break;
    while (misfits.size() < run.num) {
      misfits.push_back(MisfitOf(sensor, last - misfits.size() * step, span, belief));
    }
    const std::optional<Vector3> direction = CommonDirection(misfits, run.min_mean);
    if (!direction) continue;
    const Misfit& misfit = misfits.front();
    const double span_s = SecondsBetween(pose(last - span).stamp, pose(last).stamp);
    const double off = misfit.error.norm() / (is_gyro ? span_s : span_s * span_s);
    return ImuContradiction{
        .sensor = sensor,
        .since = pose(last - num_poses_before).stamp,
        .axis_imu = misfit.R_imu_axes * *direction,
        .seen = std::abs(misfit.seen.dot(*direction)),
        .evidence = is_gyro ? fmt::format("the gyro is {:.2f} rad/s off", off)
                            : fmt::format("the accelerometer is {:.1f} m/s^2 off", off)};
  }
  return std::nullopt;
}

std::optional<ImuContradiction> ImuAgreement::Find(const Belief& belief) const {
  if (poses_.size() < 2) return std::nullopt;
  for (const std::size_t span : kImuAgreement.spans) {
    if (auto found = FindIn(ImuSensor::kGyro, span, belief)) return found;
  }
  if (belief.g_map.isZero()) return std::nullopt;
  for (const std::size_t span : kImuAgreement.spans) {
    if (auto found = FindIn(ImuSensor::kAccelerometer, span, belief)) return found;
  }
  return std::nullopt;
}

std::optional<ImuContradiction> ImuAgreement::FindAfterJump(const Belief& belief) const {
  if (poses_.size() < 2) return std::nullopt;
  return FindIn(ImuSensor::kGyro, 1, belief, kImuAgreement.runs_after_jump);
}

bool ImuAgreement::HasShownAlike(const ImuContradiction& earlier, Timestamp from) const {
  const std::size_t span = kImuAgreement.shown_span;
  const std::size_t num_before = earlier.sensor == ImuSensor::kGyro ? span : 2 * span;
  for (std::size_t end = num_before; end < poses_.size(); ++end) {
    if (pose(end - num_before).stamp < from) continue;
    const Misfit misfit = MisfitOf(earlier.sensor, end, span, {});
    const Vector3 seen_imu = misfit.R_imu_axes * misfit.seen;
    if (std::abs(seen_imu.dot(earlier.axis_imu)) >= kImuAgreement.shown_share * earlier.seen) {
      return true;
    }
  }
  return false;
}

std::optional<ImuAgreement::Motion> ImuAgreement::MotionNow() const {
  if (poses_.size() < 2) return std::nullopt;
  const MatchedPose& to = poses_.back().pose;
  constexpr std::size_t kNumPoses = 3;
  const MatchedPose& from = pose(poses_.size() - std::min(poses_.size(), kNumPoses));
  const double span_s = SecondsBetween(from.stamp, to.stamp);
  const Quaternion R_imu_map = to.T_map_imu.rotation.conjugate();
  return Motion{R_imu_map * (to.T_map_imu.translation - from.T_map_imu.translation) / span_s,
                LogSo3(from.T_map_imu.rotation.conjugate() * to.T_map_imu.rotation) / span_s};
}

bool ImuAgreement::HasJumped(const Belief& belief) const {
  if (poses_.size() < 3 || belief.g_map.isZero()) return false;
  const std::size_t last = poses_.size() - 1;
  const double span_s = SecondsBetween(pose(last - 1).stamp, pose(last).stamp);
  return BendMisfit(last, 1, belief).error.norm() > kImuAgreement.jump_mps2 * span_s * span_s;
}

bool ImuAgreement::HasMoved() const {
  const std::optional<Motion> motion = MotionNow();
  return motion && (motion->v_imu_mps.norm() > kImuAgreement.motion_mps ||
                    motion->w_imu_radps.norm() > kImuAgreement.motion_radps);
}

}  // namespace lio
