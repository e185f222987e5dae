// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/motion_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr MotionEvidenceParameters kEvidence = kImuConventionParameters.evidence;

double Square(double x) {
  return x * x;
}

// Returns the mean sample without spikes. A rate is a spike when it is beyond any gyro and, since
// the unit is not known, also far above the median.
ImuSample MeanWithoutSpikes(std::span<const ImuSample> sent) {
  std::vector<double> rates;
  for (const ImuSample& sample : sent) rates.push_back(sample.w_imu_radps.norm());
  const auto middle = rates.begin() + std::ssize(rates) / 2;
  std::nth_element(rates.begin(), middle, rates.end());
  const double limit = std::max(kMaxGyroRate_radps, kEvidence.spike_ratio * *middle);
  ImuSample mean;
  double num = 0.0;
  for (const ImuSample& sample : sent) {
    if (sample.w_imu_radps.norm() > limit) continue;
    mean.w_imu_radps += sample.w_imu_radps;
    mean.f_imu_mps2 += sample.f_imu_mps2;
    num += 1.0;
  }
  mean.w_imu_radps /= num;
  mean.f_imu_mps2 /= num;
  return mean;
}

}  // namespace

Vector3 MotionEvidence::Step::TurnError(const Matrix3& R_imu_sent, double rate_scale) const {
  return rate_scale * span_s() * (R_imu_sent * w_sent) - turn_rad;
}

// R_map_imu R f = sum over r of (column r of R_map_imu) (f^T) (row r of R)^T.
Vector3 MotionEvidence::Bend::ForceInMap(const Matrix3& R_imu_sent) const {
  Vector3 force = Vector3::Zero();
  for (int r = 0; r < 3; ++r) force += force_in_map[r] * R_imu_sent.row(r).transpose();
  return force;
}

void MotionEvidence::BeginMap(Timestamp from) {
  ++map_;
  last_.reset();
  std::erase_if(steps_, [from](const Step& step) { return step.to.stamp > from; });
}

void MotionEvidence::AddPose(const StampedPose& T_map_imu, std::span<const ImuSample> sent) {
  const std::optional<StampedPose> last = std::exchange(last_, T_map_imu);
  if (!last || sent.size() < 2) return;
  Step step;
  step.map = map_;
  step.from = *last;
  step.to = T_map_imu;
  if (step.to.stamp - step.from.stamp > kScanGap.unrelated || step.span_s() <= 0.0) {
    ++map_;  // the poses before and after are not joined
    return;
  }
  const Quaternion& R_from = step.from.pose.rotation;
  const Quaternion& R_to = step.to.pose.rotation;
  step.turn_rad = LogSo3(R_from.conjugate() * R_to);
  const ImuSample mean = MeanWithoutSpikes(sent);
  step.w_sent = mean.w_imu_radps;
  step.f_sent = mean.f_imu_mps2;
  step.R_map_imu = R_from.slerp(0.5, R_to).toRotationMatrix();
  if (steps_.size() >= kEvidence.max_steps) steps_.erase(steps_.begin());
  steps_.push_back(step);
}

MotionEvidence MotionEvidence::Shifted(double num_steps) const {
  MotionEvidence shifted = *this;
  shifted.steps_.clear();
  const double floor = std::floor(num_steps);
  const double fraction = num_steps - floor;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const std::ptrdiff_t a = static_cast<std::ptrdiff_t>(k) + static_cast<std::ptrdiff_t>(floor);
    if (a < 0 || a + 1 >= std::ssize(steps_)) continue;
    const Step& before = steps_[static_cast<std::size_t>(a)];
    const Step& after = steps_[static_cast<std::size_t>(a + 1)];
    Step step = steps_[k];
    step.w_sent = (1.0 - fraction) * before.w_sent + fraction * after.w_sent;
    step.f_sent = (1.0 - fraction) * before.f_sent + fraction * after.f_sent;
    shifted.steps_.push_back(step);
  }
  return shifted;
}

// Returns the bend at the end of step k, over about half a second to either side; absent when the
// evidence does not reach so far.
std::optional<MotionEvidence::Bend> MotionEvidence::BendAbout(std::size_t k) const {
  const StampedPose& middle = steps_[k].to;
  const auto is_joined = [&](std::size_t i) {
    return i < steps_.size() && steps_[i].map == steps_[k].map;
  };
  const auto before_s = [&](std::size_t i) {
    return SecondsBetween(steps_[i].from.stamp, middle.stamp);
  };
  const auto after_s = [&](std::size_t i) {
    return SecondsBetween(middle.stamp, steps_[i].to.stamp);
  };
  std::size_t first = k;
  while (first > 0 && is_joined(first - 1) &&
         before_s(first) < kEvidence.second_difference_span_s) {
    --first;
  }
  std::size_t last = k;
  while (is_joined(last + 1) && after_s(last) < kEvidence.second_difference_span_s) ++last;
  const double rise_s = before_s(first);
  const double fall_s = after_s(last);
  if (std::min(rise_s, fall_s) < kEvidence.min_span_share * kEvidence.second_difference_span_s) {
    return std::nullopt;
  }

  Bend bend;
  bend.map = steps_[k].map;
  bend.weight = std::min(1.0, steps_[k].span_s() / rise_s);
  const Vector3& p = middle.pose.translation;
  const Vector3 v_before = (p - steps_[first].from.pose.translation) / rise_s;
  const Vector3 v_after = (steps_[last].to.pose.translation - p) / fall_s;
  bend.a_map_mps2 = 2.0 * (v_after - v_before) / (rise_s + fall_s);
  for (std::size_t i = first; i <= last; ++i) {
    const double off_s =
        0.5 * steps_[i].span_s() - before_s(i);  // from the pose to the step's middle
    const double height = 1.0 - std::abs(off_s) / (off_s < 0.0 ? rise_s : fall_s);
    const double share = 2.0 * height * steps_[i].span_s() / (rise_s + fall_s);
    for (int r = 0; r < 3; ++r) {
      bend.force_in_map[r] += share * steps_[i].R_map_imu.col(r) * steps_[i].f_sent.transpose();
    }
  }
  return bend;
}

std::vector<MotionEvidence::Bend> MotionEvidence::FindBends() const {
  std::vector<Bend> bends;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (const std::optional<Bend> bend = BendAbout(k)) bends.push_back(*bend);
  }
  return bends;
}

bool MotionEvidence::HasMoved() const {
  if (std::ssize(steps_) < kEvidence.recent_steps) return false;
  const Step& first = *(steps_.end() - kEvidence.recent_steps);
  const Pose motion = first.from.pose.Inverse() * steps_.back().to.pose;
  return motion.translation.norm() > kEvidence.min_motion_m ||
         LogSo3(motion.rotation).norm() > kEvidence.min_motion_rad;
}

// Returns the minimum over the gyro bias, whose prior has zero mean.
double MotionEvidence::RateScore(const Matrix3& R_imu_sent, double rate_scale) const {
  double sum_sq = 0.0;
  double times_sq = 0.0;
  Vector3 by_time = Vector3::Zero();
  for (const Step& step : steps_) {
    const Vector3 off = step.TurnError(R_imu_sent, rate_scale);
    sum_sq += off.squaredNorm();
    by_time += step.span_s() * off;
    times_sq += Square(step.span_s());
  }
  const double prior = Square(kEvidence.turn_std_rad / kEvidence.gyro_bias_std_radps);
  return (sum_sq - by_time.squaredNorm() / (times_sq + prior)) / Square(kEvidence.turn_std_rad);
}

double MotionEvidence::ForceScore(std::span<const Bend> bends, const Matrix3& R_imu_sent,
                                  double force_scale, double gravity_mps2) {
  double score = 0.0;
  for (std::size_t i = 0; i < bends.size();) {
    const int map = bends[i].map;
    double weights = 0.0;
    double sum_sq = 0.0;
    Vector3 sum = Vector3::Zero();
    for (; i < bends.size() && bends[i].map == map; ++i) {
      const Vector3 g_map = bends[i].a_map_mps2 - force_scale * bends[i].ForceInMap(R_imu_sent);
      weights += bends[i].weight;
      sum += bends[i].weight * g_map;
      sum_sq += bends[i].weight * g_map.squaredNorm();
    }
    const Vector3 mean = sum / weights;
    score += (sum_sq - weights * mean.squaredNorm()) / Square(kEvidence.second_difference_std_mps2);
    score += Square(mean.norm() - gravity_mps2) /
             (Square(kEvidence.gravity_std_mps2) +
              Square(kEvidence.second_difference_std_mps2) / weights);
  }
  return score;
}

double MotionEvidence::RateError_radps(double score) const {
  double times_sq = 0.0;
  for (const Step& step : steps_) times_sq += Square(step.span_s());
  return kEvidence.turn_std_rad * std::sqrt(score / times_sq);
}

double MotionEvidence::ForceError_mps2(std::span<const Bend> bends, double score) {
  double weights = 0.0;
  for (const Bend& bend : bends) weights += bend.weight;
  return kEvidence.second_difference_std_mps2 * std::sqrt(score / std::max(1.0, weights));
}

}  // namespace lio
