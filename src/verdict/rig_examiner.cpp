// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_examiner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "lio/verdict/rig_findings.hpp"
#include "verdict/data_findings.hpp"

namespace lio {
namespace {

Trust LeastOf(const std::vector<Cause>& causes, Trust least) {
  for (const Cause& cause : causes) least = std::max(least, cause.leaves);
  return least;
}

Trust TrustIn(double coverage, const ClaimedAccuracy& claimed) {
  if (coverage < kRigExaminer.least_coverage) return Trust::kNo;
  const bool is_vague =
      claimed.position_std_m_per_100m.value_or(0.0) > kRigExaminer.doubtful_claim_m;
  return is_vague || coverage < kRigExaminer.doubtful_coverage ? Trust::kDoubtful : Trust::kYes;
}

}  // namespace

RigExaminer::RigExaminer(const Rig& rig, bool uses_imu, bool is_lever_found)
    : rig_(rig),
      uses_imu_(uses_imu),
      is_lever_found_(is_lever_found),
      convention_(ConventionOf(rig.imu.units)) {}

void RigExaminer::SetConvention(const ImuConvention& convention) {
  convention_ = convention;
  record_.Clear();
  bounds_.reset();
  told_.reset();
}

std::optional<RigFindings> RigExaminer::Look(Timestamp stamp) {
  if (!first_stamp_) first_stamp_ = stamp;
  // A clock that was set back takes nothing off the time that was driven.
  if (last_stamp_ && stamp < *last_stamp_) *first_stamp_ = *first_stamp_ + (stamp - *last_stamp_);
  last_stamp_ = stamp;
  if (SecondsBetween(*first_stamp_, stamp) < next_look_s_) return std::nullopt;
  next_look_s_ *= kRigExaminer.next_look_factor;
  RigFindings findings = FindRigErrors(record_, rig_, convention_, is_lever_found_);
  trust_ = LeastOf(findings.causes, LeastOf(corrected_, Trust::kYes));
  bounds_ = findings.bounds;
  return findings;
}

std::optional<std::string> RigExaminer::News(const RigFindings& findings) {
  const auto worst = std::ranges::find(findings.causes, Trust::kNo, &Cause::leaves);
  if (told_ || worst == findings.causes.end()) return std::nullopt;
  told_ = *worst;
  return fmt::format("the result cannot be trusted: {}: {}", Name(told_->kind), told_->evidence);
}

void RigExaminer::SetExtrinsic(const RigFindings& findings, const Pose& T_imu_lidar,
                               const Pose& T_old_new) {
  if (!rig_.T_imu_lidar) rig_.T_imu_lidar.emplace();
  is_lever_found_ |= T_imu_lidar.translation != rig_.T_imu_lidar->translation;
  static_cast<Pose&>(*rig_.T_imu_lidar) = T_imu_lidar;  // known as well as before
  bounds_.reset();
  told_.reset();
  if (findings.T_imu_lidar) {
    first_stamp_.reset();
    last_stamp_.reset();
    next_look_s_ = kRigExaminer.first_look_s;
    std::ranges::copy_if(findings.causes, std::back_inserter(corrected_), IsOfExtrinsic);
    record_.Clear();  // sweeps were deskewed wrongly
  } else {
    record_.SetImu(T_old_new);
  }
  for (Cause& cause : corrected_) {
    cause.leaves = Trust::kDoubtful;
    cause.fix = ExtrinsicYaml(InAxesOfMessages(T_imu_lidar, convention_));
  }
  trust_ = Trust::kDoubtful;
}

Verdict RigExaminer::Judge(const Counters& counters, std::vector<Cause> suspected) const {
  Verdict verdict;
  verdict.coverage = tally_.Coverage();
  verdict.path_m = tally_.path_m();
  verdict.claimed = tally_.Claimed();
  verdict.causes = contradictions_;
  const auto append = [&](std::vector<Cause> causes) {
    verdict.causes.insert(verdict.causes.end(), std::make_move_iterator(causes.begin()),
                          std::make_move_iterator(causes.end()));
  };
  append(corrected_);
  append(FindRigErrors(record_, rig_, convention_, is_lever_found_).causes);
  if (told_ && !std::ranges::count(verdict.causes, told_->kind, &Cause::kind)) {
    verdict.causes.push_back(*told_);
  }
  std::erase_if(suspected, [&verdict](const Cause& cause) {
    return std::ranges::count(verdict.causes, cause.kind, &Cause::kind) > 0;
  });
  append(std::move(suspected));
  const ImuRig* imu = uses_imu_ ? &rig_.imu : nullptr;
  if (contradictions_.empty()) append(FindDataFaults(counters, tally_, imu));
  // Equal ones stay in their order: rigs are more often wrong than data.
  std::ranges::stable_sort(verdict.causes, std::greater<>{}, &Cause::leaves);
  verdict.trust = LeastOf(verdict.causes, TrustIn(verdict.coverage, verdict.claimed));
  return verdict;
}

}  // namespace lio
