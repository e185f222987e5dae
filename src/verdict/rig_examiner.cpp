// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_examiner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "lio/verdict/data_findings.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {
namespace {

Trust LeastOf(const std::vector<Cause>& causes, Trust least) {
  for (const Cause& cause : causes) least = std::max(least, cause.leaves);
  return least;
}

Trust TrustIn(double coverage) {
  if (coverage < kRigExaminer.least_coverage) return Trust::kNo;
  return coverage < kRigExaminer.doubtful_coverage ? Trust::kDoubtful : Trust::kYes;
}

}  // namespace

RigExaminer::RigExaminer(const Rig& rig, bool uses_imu)
    : rig_(rig), uses_imu_(uses_imu), convention_(ConventionOf(rig.imu.units)) {}

void RigExaminer::SetConvention(const ImuConvention& convention) {
  convention_ = convention;
  record_.Clear();
}

std::optional<std::string> RigExaminer::News(Timestamp stamp) {
  if (!first_stamp_) first_stamp_ = stamp;
  if (has_told_ || SecondsBetween(*first_stamp_, stamp) < next_look_s_) return std::nullopt;
  next_look_s_ *= 2.0;
  const RigFindings findings = FindRigErrors(record_, rig_, convention_);
  trust_ = LeastOf(findings.causes, Trust::kYes);
  if (trust_ != Trust::kNo) return std::nullopt;
  has_told_ = true;
  const Cause& cause = findings.causes.front();
  return fmt::format("the result cannot be trusted: {}: {}", Name(cause.kind), cause.evidence);
}

Verdict RigExaminer::Judge(const Counters& counters) const {
  Verdict verdict;
  verdict.coverage = tally_.Coverage();
  verdict.claimed = tally_.Claimed();
  verdict.causes = contradictions_;
  const auto append = [&](std::vector<Cause> causes) {
    verdict.causes.insert(verdict.causes.end(), std::make_move_iterator(causes.begin()),
                          std::make_move_iterator(causes.end()));
  };
  append(FindRigErrors(record_, rig_, convention_).causes);
  if (contradictions_.empty()) append(FindDataFaults(counters, tally_, uses_imu_));
  // Equal ones stay in their order: rigs are more often wrong than data.
  std::ranges::stable_sort(verdict.causes, std::greater<>{}, &Cause::leaves);
  verdict.trust = LeastOf(verdict.causes, TrustIn(verdict.coverage));
  return verdict;
}

}  // namespace lio
