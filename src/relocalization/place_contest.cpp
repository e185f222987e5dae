// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_contest.hpp"

#include <algorithm>
#include <utility>

#include "lio/registration/degenerate_directions.hpp"
#include "lio/relocalization/candidate.hpp"
#include "lio/relocalization/parameters.hpp"
#include "lio/relocalization/tried_places.hpp"
#include "relocalization/place_candidates.hpp"
#include "relocalization/place_verification.hpp"

namespace lio {
namespace {

constexpr PlaceContestParameters kContest = kRelocalization.contest;
constexpr RivalParameters kRival = kRelocalization.rival;

PlaceFit FitOf(const MatchResult& there, const MatchResult& in_new_map) {
  if (!MayBeThere(there)) return {0.0, 0.0, 0.0};
  const double num = in_new_map.num_matched;
  const double num_against = there.num_in_map - there.num_matched;
  return {std::min(1.0, ShareOf(there) / ShareOf(in_new_map)), there.num_matched / num,
          (there.num_matched - kRival.weight_against * num_against) / num};
}

Matrix6 SettledCov() {
  return CandidateCov(kContest.settled_std_m, kContest.settled_std_rad);
}

// A match that solves degenerate directions, too, knows them as well as the places of scans agree.
Matrix6 CovOf(const MatchResult& match) {
  constexpr double kShare = kContest.settled_std_m / DegeneracyParameters::kDegenerateStd_m;
  return match.observable_cov + kShare * kShare * (match.cov - match.observable_cov);
}

bool HasStayed(const Pose& before, const Pose& after) {
  const Pose step = before.Inverse() * after;
  return step.translation.norm() < kContest.max_step_m &&
         LogSo3(step.rotation).norm() < kContest.max_step_rad;
}

}  // namespace

PlaceContest::PlaceContest(CloudSample sample, const std::vector<Pose>& T_initial_map,
                           const Matrix6& cov)
    : sample_(std::move(sample)), place_cov_(cov) {
  for (const Pose& place : T_initial_map) contenders_.push_back({.T_initial_map = place});
}

bool PlaceContest::Contender::is_good() const {
  return num_good_in_a_row >= kContest.num_checks;
}

bool PlaceContest::Contender::is_observable() const {
  return LeastInformationRatio(information, noise) >= kContest.min_information_ratio;
}

PlaceFit PlaceContest::Contender::fit() const {
  if (last_fits.empty()) return {};
  PlaceFit sum{0.0, 0.0, 0.0};
  for (const PlaceFit& fit : last_fits) {
    sum.share += fit.share;
    sum.number += fit.number;
    sum.score += fit.score;
  }
  const auto num = static_cast<double>(last_fits.size());
  return {sum.share / num, sum.number / num, sum.score / num};
}

// Each at its best: a place that matches come to only at the second time is there all the same.
PlaceFit PlaceContest::Contender::best_fit() const {
  PlaceFit best{0.0, 0.0, 0.0};
  for (const PlaceFit& fit : last_fits) {
    best.share = std::max(best.share, fit.share);
    best.number = std::max(best.number, fit.number);
    best.score = std::max(best.score, fit.score);
  }
  return best;
}

bool PlaceContest::is_over() const {
  if (contenders_.empty()) return true;
  const Contender& leader = contenders_.front();
  const bool may_win = leader.is_good() && leader.is_observable();
  return num_scans_ >= (may_win ? kContest.max_scans_of_good : kContest.max_scans);
}

bool PlaceContest::Rank(const MatchInInitial& match) {
  const Pose T_map_sample{Quaternion::Identity(), sample_.centre_map};
  for (int i = 0; i < kContest.max_coarse_per_scan && num_ranked_ < contenders_.size(); ++i) {
    Contender& contender = contenders_[num_ranked_++];
    const MatchResult there =
        match(sample_.points, contender.T_initial_map * T_map_sample, place_cov_);
    contender.support = SupportOf(there);
    if (contender.support > 0.0) {
      contender.T_initial_map = there.T_map_imu * T_map_sample.Inverse();
    }
  }
  if (num_ranked_ < contenders_.size()) return false;
  KeepTheBest();
  return true;
}

void PlaceContest::KeepTheBest() {
  std::stable_sort(contenders_.begin(), contenders_.end(),
                   [](const auto& a, const auto& b) { return a.support > b.support; });
  MergeSame();
  const double least =
      contenders_.empty() ? 0.0 : kContest.min_support_ratio * contenders_.front().support;
  std::erase_if(contenders_,
                [&](const Contender& c) { return !(c.support > 0.0 && c.support >= least); });
  if (contenders_.size() > kContest.max_contenders) contenders_.resize(kContest.max_contenders);
}

// Two that have come to one place are one: the first stays.
void PlaceContest::MergeSame() {
  const Pose T_map_sample{Quaternion::Identity(), sample_.centre_map};
  std::vector<Contender> kept;
  for (Contender& contender : contenders_) {
    const auto is_same = [&](const Contender& other) {
      return IsSamePlace(contender.T_initial_map * T_map_sample,
                         other.T_initial_map * T_map_sample);
    };
    if (std::none_of(kept.begin(), kept.end(), is_same)) kept.push_back(std::move(contender));
  }
  contenders_ = std::move(kept);
}

void PlaceContest::CheckAt(Contender& contender, const LocatedScan& scan,
                           const MatchInInitial& match) const {
  const Pose& T_map_imu = scan.match.T_map_imu;
  const bool is_settled = contender.num_checks > 0;
  const MatchResult there = match(scan.points_imu, contender.T_initial_map * T_map_imu,
                                  is_settled ? SettledCov() : place_cov_);
  const Pose T_initial_map = there.T_map_imu * T_map_imu.Inverse();
  const PlaceFit fit = FitOf(there, scan.match);
  const bool has_stayed =
      !is_settled || HasStayed(contender.T_initial_map * T_map_imu, there.T_map_imu);
  const bool is_good = there.IsUsable() && has_stayed &&
                       fit.ShareWith(kContest.min_number_ratio) >= kContest.min_fit;
  ++contender.num_checks;
  contender.num_good_in_a_row = is_good ? contender.num_good_in_a_row + 1 : 0;
  if (!is_good) contender.information = contender.noise = Matrix6::Zero();
  contender.last_fits.push_back(fit);
  if (contender.last_fits.size() > std::size_t{kContest.num_checks})
    contender.last_fits.pop_front();
  if (!there.IsUsable()) return;
  contender.T_initial_map = T_initial_map;
  contender.cov = CovOf(there);
  if (is_good) CountInformation(contender, T_map_imu, there.observability);
}

void PlaceContest::CountInformation(Contender& contender, const Pose& T_map_imu,
                                    const Observability& observability) const {
  const Pose T_map_sample{Quaternion::Identity(), sample_.centre_map};
  const Matrix6 of_sample = AdjointSe3(T_map_imu.Inverse() * T_map_sample);
  contender.information += of_sample.transpose() * observability.counted * of_sample;
  contender.noise += of_sample.transpose() * observability.noise * of_sample;
}

void PlaceContest::OrderByFit() {
  std::stable_sort(contenders_.begin(), contenders_.end(), [](const auto& a, const auto& b) {
    return a.fit().ShareWith(kContest.min_number_ratio) >
           b.fit().ShareWith(kContest.min_number_ratio);
  });
}

bool PlaceContest::IsBeatenByLeader(const Contender& rival) const {
  if (rival.num_checks < kRival.num_checks) return false;
  const PlaceFit of_rival = rival.best_fit();
  const PlaceFit of_leader = contenders_.front().fit();
  const auto is_beaten = [&](double least_residual) {
    const double share = of_rival.ShareWith(kContest.min_number_ratio * of_leader.number);
    return IsBeaten(1.0 - share, 1.0 - of_leader.share, least_residual);
  };
  const bool is_behind = of_rival.score < kRival.max_score_ratio * of_leader.score;
  return is_beaten(kRival.least_residual) ||
         (path_m_ > kRival.moved_on_m && is_beaten(kRival.least_residual_moved_on) && is_behind);
}

bool PlaceContest::HasWinner() const {
  const Contender& leader = contenders_.front();
  return leader.is_good() && leader.is_observable() &&
         std::all_of(contenders_.begin() + 1, contenders_.end(),
                     [&](const Contender& rival) { return IsBeatenByLeader(rival); });
}

std::optional<FoundPlace> PlaceContest::Check(const LocatedScan& scan, const MatchInInitial& match,
                                              int max_matches) {
  if (is_over() || max_matches <= 0 || !scan.match.IsUsable()) return {};
  ++num_scans_;
  const Vector3& position_map = scan.match.T_map_imu.translation;
  path_m_ += (position_map - last_position_map_.value_or(position_map)).norm();
  last_position_map_ = position_map;
  CheckAt(contenders_.front(), scan, match);
  if (max_matches > 1 && contenders_.size() > 1) {
    const auto rival =
        std::min_element(contenders_.begin() + 1, contenders_.end(),
                         [](const auto& a, const auto& b) { return a.num_checks < b.num_checks; });
    CheckAt(*rival, scan, match);
  }
  MergeSame();
  if (HasWinner()) return FoundPlace{contenders_.front().T_initial_map, contenders_.front().cov};
  OrderByFit();
  return {};
}

}  // namespace lio
