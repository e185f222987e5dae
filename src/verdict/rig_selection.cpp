// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/rig_selection.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <optional>

#include "lio/base/angle.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {
namespace {

constexpr std::array kSuspects = {CauseKind::kExtrinsicRotation, CauseKind::kClockOffset,
                                  CauseKind::kLeverArm};

FreeErrors OnlyFree(const std::vector<CauseKind>& kinds) {
  const auto has = [&](CauseKind kind) { return std::ranges::count(kinds, kind) > 0; };
  return {has(CauseKind::kExtrinsicRotation), has(CauseKind::kClockOffset),
          has(CauseKind::kLeverArm)};
}

}  // namespace

double SureSigmas(int num_clusters, double probability) {
  const boost::math::students_t distribution(std::max(1, num_clusters - 1));
  return boost::math::quantile(boost::math::complement(distribution, 0.5 * probability));
}

double Sigmas(const Eigen::VectorXd& value, const Eigen::MatrixXd& cov) {
  return std::sqrt(value.dot(cov.ldlt().solve(value)));
}

double SurePart(const Eigen::VectorXd& value, const Eigen::MatrixXd& cov, double sure_sigmas) {
  double sum_sq = 0.0;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const double sure = std::abs(value[i]) - sure_sigmas * std::sqrt(cov(i, i));
    if (sure > 0.0) sum_sq += sure * sure;
  }
  return std::sqrt(sum_sq);
}

double AngleDeg(const Quaternion& rotation) {
  return kDegPerRad * LogSo3(rotation).norm();
}

RigSelection::RigSelection(RigFit& fit, const RigFit::TurnAlignment& turns) {
  FitAll(fit, turns);
  Select(fit);
}

bool RigSelection::IsSelected(CauseKind kind) const {
  return std::ranges::count(selected_, kind) > 0;
}

void RigSelection::FitAll(RigFit& fit, const RigFit::TurnAlignment& turns) {
  RigFitResult first = fit.Solve(fit.StartAt(Quaternion::Identity()), {});
  if (AngleDeg(turns.rotation) > kRigFindings.large_rotation_deg) {
    const RigFitResult other = fit.Solve(fit.StartAt(turns.rotation), {});
    if (other.cost < first.cost) first = other;
  }
  RigErrors start = first.errors;
  fit.SetNoiseFrom(start);
  start = fit.Solve(start, {}).errors;
  fit.SetNoiseFrom(start);
  all_ = fit.Solve(start, {});
  sure_sigmas_ = SureSigmas(all_.num_clusters, kRigFindings.false_alarm_probability);
}

// The full fit says this of one error.
RigSelection::Suspect RigSelection::Judge(CauseKind kind) const {
  const auto judge = [&](const Eigen::VectorXd& value, int at, double tolerance) {
    const Eigen::MatrixXd cov = all_.cov.block(at, at, value.size(), value.size());
    return Suspect{SurePart(value, cov, sure_sigmas_) / tolerance, Sigmas(value, cov)};
  };
  switch (kind) {
    case CauseKind::kExtrinsicRotation:
      return judge(LogSo3(all_.errors.rotation), kRigRotation,
                   kRigFindings.rotation_tolerance_deg / kDegPerRad);
    case CauseKind::kClockOffset:
      return judge(Eigen::VectorXd::Constant(1, all_.errors.offset_s), kRigOffset,
                   kRigFindings.offset_tolerance_s);
    default:
      return judge(all_.errors.lever_m, kRigLever, kRigFindings.lever_tolerance_m);
  }
}

RigFitResult RigSelection::SolveWith(const RigFit& fit, const std::vector<CauseKind>& kinds) const {
  const FreeErrors free = OnlyFree(kinds);
  RigErrors start = all_.errors;
  if (!free.rotation) start.rotation = Quaternion::Identity();
  if (!free.offset) start.offset_s = 0.0;
  if (!free.lever) start.lever_m = Vector3::Zero();
  return fit.Solve(start, free);
}

// Forward selection: the error that explains most, then those that explain a share of it.
void RigSelection::Select(const RigFit& fit) {
  solution_ = all_;
  const bool has_suspect = std::ranges::any_of(
      kSuspects, [this](CauseKind kind) { return Judge(kind).in_tolerances >= 1.0; });
  if (!has_suspect) {  // then nothing is mended
    solution_.errors.rotation = Quaternion::Identity();
    return;
  }
  solution_ = SolveWith(fit, {});
  double first_gain = 0.0;
  while (selected_.size() < kSuspects.size()) {
    std::optional<CauseKind> best;
    RigFitResult best_result = solution_;
    for (const CauseKind kind : kSuspects) {
      if (IsSelected(kind) || Judge(kind).in_tolerances < 1.0) continue;
      std::vector<CauseKind> kinds = selected_;
      kinds.push_back(kind);
      const RigFitResult result = SolveWith(fit, kinds);
      if (result.cost >= best_result.cost) continue;
      best = kind;
      best_result = result;
    }
    const double gain = solution_.cost - best_result.cost;
    if (!best || gain < kRigFindings.min_share_of_first * first_gain) return;
    first_gain = std::max(first_gain, gain);
    selected_.push_back(*best);
    solution_ = best_result;
  }
}

}  // namespace lio
