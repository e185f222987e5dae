// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/rig_fit.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lio/base/chi_square.hpp"

namespace lio {
namespace {

int LongestMap(const std::deque<MotionStep>& steps) {
  std::map<int, int> num_of;
  for (const MotionStep& step : steps) ++num_of[step.map];
  const auto longest =
      std::max_element(num_of.begin(), num_of.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return longest == num_of.end() ? 0 : longest->first;
}

Vector3 MatchedTurn(const MotionStep& step) {
  return LogSo3(step.from.pose.rotation.conjugate() * step.to.pose.rotation);
}

double HuberWeight(double sigmas, double threshold) {
  return sigmas <= threshold ? 1.0 : threshold / sigmas;
}

double HuberCost(double sigmas, double threshold) {
  return sigmas <= threshold ? sigmas * sigmas : 2.0 * threshold * sigmas - threshold * threshold;
}

}  // namespace

struct RigFit::Normal {
  RigMatrix A = RigMatrix::Zero();
  RigVector b = RigVector::Zero();
  double cost = 0.0;
  std::map<std::int64_t, RigVector> scores;  // by cluster of time

  RigMatrix ScoreCov() const {
    RigMatrix cov = RigMatrix::Zero();
    for (const auto& [cluster, score] : scores) cov += score * score.transpose();
    return cov;
  }
};

RigFit::RigFit(const MotionRecord& record, double accel_bias_std_mps2)
    : record_(record), accel_bias_std_mps2_(accel_bias_std_mps2) {
  const int map = LongestMap(record.steps());
  bends_ = {FindBends(kRigFit.short_span_s, map), FindBends(kRigFit.long_span_s, map)};
}

bool RigFit::HasEnough() const {
  return record_.steps().size() >= kRigFit.min_steps && bends_[1].size() >= kRigFit.min_steps;
}

std::vector<RigFit::Bend> RigFit::FindBends(double span_s, int map) const {
  const auto& steps = record_.steps();
  std::vector<Bend> bends;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].map != map) continue;
    const Timestamp middle = steps[k].to.stamp;
    const auto is_joined = [&](std::size_t i) {
      return i < steps.size() && steps[i].track == steps[k].track;
    };
    const double slack_s = 0.25 * steps[k].span_s();  // stamps jitter; a quarter is chosen
    std::size_t first = k;
    while (first > 0 && is_joined(first - 1) &&
           SecondsBetween(steps[first].from.stamp, middle) < span_s - slack_s) {
      --first;
    }
    std::size_t last = k + 1;
    while (is_joined(last + 1) && SecondsBetween(middle, steps[last].to.stamp) < span_s - slack_s) {
      ++last;
    }
    if (!is_joined(last)) continue;
    const double rise_s = SecondsBetween(steps[first].from.stamp, middle);
    const double fall_s = SecondsBetween(middle, steps[last].to.stamp);
    if (std::min(rise_s, fall_s) < span_s - slack_s) continue;
    const auto bend_of = [&](const auto& a, const auto& b, const auto& c) {
      return (2.0 / (rise_s + fall_s) * ((c - b) / fall_s - (b - a) / rise_s)).eval();
    };
    const Pose& a = steps[first].from.pose;
    const Pose& b = steps[k].to.pose;
    const Pose& c = steps[last].to.pose;
    Bend bend;
    bend.stamp = middle;
    bend.weight = std::min(1.0, steps[k].span_s() / rise_s);
    bend.a_map_mps2 = bend_of(a.translation, b.translation, c.translation);
    bend.rotation_bend = bend_of(a.rotation.toRotationMatrix(), b.rotation.toRotationMatrix(),
                                 c.rotation.toRotationMatrix());
    for (std::size_t i = first; i <= last; ++i) {
      const MotionStep& step = steps[i];
      const double dt = step.span_s();
      const double from_s = SecondsBetween(middle, step.from.stamp);
      const double slope = i <= k ? 1.0 / rise_s : -1.0 / fall_s;
      const double height_at_to = 1.0 + slope * (from_s + dt);
      const double share = (height_at_to - 0.5 * slope * dt) * dt;
      // The weight is linear within the step: its integrals are those of velocity and position.
      const Vector3 f = (height_at_to * step.velocity_mps - slope * step.position_m) / share -
                        step.clock_correction_s * step.jerk_mps3;
      bend.parts.push_back(
          {2.0 * share / (rise_s + fall_s), f, step.jerk_mps3,
           step.from.pose.rotation.slerp(0.5, step.to.pose.rotation).toRotationMatrix()});
    }
    bends.push_back(std::move(bend));
  }
  return bends;
}

RigErrors RigFit::StartAt(const Quaternion& rotation) const {
  RigErrors errors;
  errors.rotation = rotation;
  Vector3 sum = Vector3::Zero();
  for (const Bend& bend : bends_[1]) sum += BendRow(bend, errors).residual;
  if (!bends_[1].empty()) errors.g_map_mps2 = sum / static_cast<double>(bends_[1].size());
  return errors;
}

RigFit::TurnAlignment RigFit::AlignTurns() const {
  const auto& steps = record_.steps();
  if (steps.empty()) return {};
  Vector3 mean_matched = Vector3::Zero();
  Vector3 mean_gyro = Vector3::Zero();
  for (const MotionStep& step : steps) {
    mean_matched += MatchedTurn(step) / static_cast<double>(steps.size());
    mean_gyro += step.turn_rad / static_cast<double>(steps.size());
  }
  Matrix3 sum = Matrix3::Zero();
  double matched_sq = 0.0;
  double gyro_sq = 0.0;
  for (const MotionStep& step : steps) {
    const Vector3 matched = MatchedTurn(step) - mean_matched;
    const Vector3 gyro = step.turn_rad - mean_gyro;
    sum += matched * gyro.transpose();
    matched_sq += matched.squaredNorm();
    gyro_sq += gyro.squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  const Vector3 signs(1.0, 1.0, sign);
  const double explained = (signs.array() * svd.singularValues().array()).sum();
  TurnAlignment alignment;
  alignment.rotation =
      Quaternion(Matrix3(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
  if (gyro_sq > 0.0 && matched_sq > 0.0) {
    alignment.ratio = explained / gyro_sq;
    alignment.correlation = explained / std::sqrt(gyro_sq * matched_sq);
  }
  return alignment;
}

RigFit::Row RigFit::TurnRow(const MotionStep& step, const RigErrors& errors) {
  const double dt = step.span_s();
  const Vector3 turn = step.turn_rad +
                       (errors.offset_s - step.clock_correction_s) * step.rate_gain_radps -
                       dt * errors.gyro_bias_radps;
  const Matrix3 E = errors.rotation.toRotationMatrix();
  Row row;
  row.stamp = step.to.stamp;
  row.residual = LogSo3(ExpSo3(E * turn).conjugate() *
                        (step.from.pose.rotation.conjugate() * step.to.pose.rotation));
  row.jacobian.setZero();
  row.jacobian.middleCols<3>(kRigRotation) = E * Hat(turn);
  row.jacobian.col(kRigOffset) = -E * step.rate_gain_radps;
  row.jacobian.middleCols<3>(kRigGyroBias) = dt * E;
  return row;
}

RigFit::Row RigFit::BendRow(const Bend& bend, const RigErrors& errors) {
  const Matrix3 E = errors.rotation.toRotationMatrix();
  Row row;
  row.stamp = bend.stamp;
  row.weight = bend.weight;
  row.residual = bend.a_map_mps2 - errors.g_map_mps2 - bend.rotation_bend * errors.lever_m;
  row.jacobian.setZero();
  for (const Bend::Part& part : bend.parts) {
    const Vector3 f = part.f_mps2 + errors.offset_s * part.jerk_mps3 - errors.accel_bias_mps2;
    const Matrix3 turned = part.share * part.R_map_imu * E;
    row.residual -= turned * f;
    row.jacobian.middleCols<3>(kRigRotation) += turned * Hat(f);
    row.jacobian.col(kRigOffset) -= turned * part.jerk_mps3;
    row.jacobian.middleCols<3>(kRigAccelBias) += turned;
  }
  row.jacobian.middleCols<3>(kRigLever) = -bend.rotation_bend;
  row.jacobian.middleCols<3>(kRigGravity) = -Matrix3::Identity();
  return row;
}

std::vector<RigFit::Row> RigFit::Rows(std::size_t group, const RigErrors& errors) const {
  std::vector<Row> rows;
  if (group == 0) {
    for (const MotionStep& step : record_.steps()) rows.push_back(TurnRow(step, errors));
  } else {
    for (const Bend& bend : bends_[group - 1]) rows.push_back(BendRow(bend, errors));
  }
  return rows;
}

void RigFit::SetNoiseFrom(const RigErrors& errors) {
  for (std::size_t group = 0; group < kNumGroups; ++group) {
    std::vector<double> squares;
    for (const Row& row : Rows(group, errors)) squares.push_back(row.residual.squaredNorm());
    if (squares.empty()) continue;
    const auto middle = squares.begin() + std::ssize(squares) / 2;
    std::nth_element(squares.begin(), middle, squares.end());
    variances_[group] = std::max(1e-12, *middle / ChiSquareQuantile(0.5, 3.0));
  }
}

// A held error moves nothing.
void RigFit::Hold(const FreeErrors& free, Jacobian& jacobian) {
  if (!free.rotation) jacobian.middleCols<3>(kRigRotation).setZero();
  if (!free.offset) jacobian.col(kRigOffset).setZero();
  if (!free.lever) jacobian.middleCols<3>(kRigLever).setZero();
}

RigFit::Normal RigFit::Accumulate(const RigErrors& errors, const FreeErrors& free) const {
  Normal normal;
  for (std::size_t group = 0; group < kNumGroups; ++group) {
    for (Row row : Rows(group, errors)) {
      Hold(free, row.jacobian);
      const double sigmas = std::sqrt(row.residual.squaredNorm() / variances_[group]);
      const double weight = row.weight * HuberWeight(sigmas, kRigFit.huber) / variances_[group];
      normal.cost += row.weight * HuberCost(sigmas, kRigFit.huber);
      normal.A += weight * row.jacobian.transpose() * row.jacobian;
      const RigVector score = -weight * row.jacobian.transpose() * row.residual;
      normal.b += score;
      const auto cluster = static_cast<std::int64_t>(
          SecondsBetween(record_.steps().front().from.stamp, row.stamp) / kRigFit.cluster_s);
      normal.scores.try_emplace(cluster, RigVector::Zero()).first->second += score;
    }
  }
  AddPrior(errors, free, normal);
  return normal;
}

void RigFit::AddPrior(const RigErrors& errors, const FreeErrors& free, Normal& normal) const {
  const auto add = [&](int at, double std, double value) {
    normal.A(at, at) += 1.0 / (std * std);
    normal.b[at] -= value / (std * std);
    normal.cost += value * value / (std * std);
  };
  add(kRigOffset, kRigFit.offset_prior_s, errors.offset_s);
  for (int i = 0; i < 3; ++i) {
    // A radian, about wherever it is: for a unique solution alone.
    normal.A(kRigRotation + i, kRigRotation + i) += 1.0;
    add(kRigLever + i, kRigFit.lever_prior_m, errors.lever_m[i]);
    add(kRigGyroBias + i, kRigFit.gyro_bias_prior_radps, errors.gyro_bias_radps[i]);
    add(kRigAccelBias + i, accel_bias_std_mps2_, errors.accel_bias_mps2[i]);
    normal.A(kRigGravity + i, kRigGravity + i) +=
        1.0 / (kRigFit.gravity_prior_mps2 * kRigFit.gravity_prior_mps2);
  }
  if (!free.offset) normal.b[kRigOffset] = 0.0;
  if (!free.lever) normal.b.segment<3>(kRigLever).setZero();
}

RigFitResult RigFit::Solve(const RigErrors& start, const FreeErrors& free) const {
  RigFitResult result;
  result.errors = start;
  RigErrors& errors = result.errors;
  for (int i = 0; i < kRigFit.num_iterations; ++i) {
    const Normal normal = Accumulate(errors, free);
    const RigVector step = normal.A.ldlt().solve(normal.b);
    errors.rotation = (errors.rotation * ExpSo3(step.segment<3>(kRigRotation))).normalized();
    errors.offset_s += step[kRigOffset];
    errors.lever_m += step.segment<3>(kRigLever);
    errors.gyro_bias_radps += step.segment<3>(kRigGyroBias);
    errors.accel_bias_mps2 += step.segment<3>(kRigAccelBias);
    errors.g_map_mps2 += step.segment<3>(kRigGravity);
  }
  const Normal normal = Accumulate(errors, free);
  const RigMatrix inverse = normal.A.ldlt().solve(RigMatrix::Identity());
  result.cov = inverse + inverse * normal.ScoreCov() * inverse;
  result.cost = normal.cost;
  result.num_clusters = static_cast<int>(normal.scores.size());
  return result;
}

}  // namespace lio
