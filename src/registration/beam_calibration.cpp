// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/beam_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

using Parameters = BeamCalibrationParameters;

// The order of the unknowns: rings come last, so that more of them can be added.
constexpr int kCos = 0;
constexpr int kSin = 1;
constexpr int kGrazing = 2;
constexpr int kRelief = 3;
constexpr int kFirstRing = 4;
constexpr int kNumPerRing = 3;
constexpr int RangeOf(int ring) {
  return kFirstRing + kNumPerRing * ring;
}
constexpr int ElevationOf(int ring) {
  return RangeOf(ring) + 1;
}
constexpr int AzimuthOf(int ring) {
  return RangeOf(ring) + 2;
}

constexpr int NumUnknowns(std::size_t num_rings) {
  return kFirstRing + kNumPerRing * static_cast<int>(num_rings);
}

BeamErrors AsBeamErrors(const Eigen::VectorXd& unknowns) {
  BeamErrors errors;
  errors.encoder_rad = unknowns.head<2>().cast<float>();
  errors.rings.resize(static_cast<std::size_t>((unknowns.size() - kFirstRing) / kNumPerRing));
  for (std::size_t ring = 0; ring < errors.rings.size(); ++ring) {
    const int number = static_cast<int>(ring);
    errors.rings[ring] = {static_cast<float>(unknowns[RangeOf(number)]),
                          static_cast<float>(unknowns[ElevationOf(number)]),
                          static_cast<float>(unknowns[AzimuthOf(number)])};
  }
  return errors;
}

// The inverse, with 0 for the grazing effect and the relief, which BeamErrors do not have.
Eigen::VectorXd AsUnknowns(const BeamErrors& errors) {
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(NumUnknowns(errors.rings.size()));
  unknowns.head<2>() = errors.encoder_rad.cast<double>();
  for (std::size_t ring = 0; ring < errors.rings.size(); ++ring) {
    const int number = static_cast<int>(ring);
    unknowns[RangeOf(number)] = errors.rings[ring].range_m;
    unknowns[ElevationOf(number)] = errors.rings[ring].elevation_rad;
    unknowns[AzimuthOf(number)] = errors.rings[ring].azimuth_rad;
  }
  return unknowns;
}

// The covariance of one kind of error of all rings after some time. Age and temperature change each
// ring by itself, all of them together, and the upper ones against the lower ones.
Eigen::MatrixXd Aged(const Eigen::VectorXd& std, double ageing_std) {
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(std.size(), -1.0, 1.0);
  const double ageing_var = ageing_std * ageing_std;
  Eigen::MatrixXd cov = ageing_var * (line * line.transpose());
  cov.array() += ageing_var;
  cov.diagonal().array() += std.array().square() + ageing_var;
  return cov;
}

// Standard deviations of an error: as data sheets allow it, and by the time since an earlier drive.
struct Allowance {
  double data_sheet_std = 0.0;
  double ageing_std = 0.0;
};

Allowance AllowanceOf(int unknown) {
  if (unknown == kGrazing) return {Parameters::kGrazingStd_m, 0.0};
  if (unknown == kRelief) return {Parameters::kReliefStd, 0.0};
  if (unknown < kGrazing) return {Parameters::kEncoderStd_rad, Parameters::kEncoderAgeing_rad};
  const bool is_range = (unknown - RangeOf(0)) % kNumPerRing == 0;
  if (is_range) return {Parameters::kRangeStd_m, Parameters::kRangeAgeing_m};
  return {Parameters::kAngleStd_rad, Parameters::kAngleAgeing_rad};
}

}  // namespace

BeamCalibration::BeamCalibration(const BeamKnowledge& known) {
  if (known.std.rings.empty()) return;
  MakeRoomFor(NumUnknowns(known.std.rings.size()));
  SetPrior(known);
  Solve();
}

void BeamCalibration::SetPrior(const BeamKnowledge& known) {
  const Eigen::VectorXd std = AsUnknowns(known.std);
  for (const int unknown : {kCos, kSin}) {
    const double aged_std = std::hypot(std[unknown], AllowanceOf(unknown).ageing_std);
    prior_information_(unknown, unknown) = 1.0 / (aged_std * aged_std);
  }
  const auto num_rings = static_cast<Eigen::Index>(known.std.rings.size());
  for (int kind = 0; kind < kNumPerRing; ++kind) {
    const auto of_kind = Eigen::seqN(kFirstRing + kind, num_rings, kNumPerRing);
    const Eigen::MatrixXd cov = Aged(std(of_kind), AllowanceOf(kFirstRing + kind).ageing_std);
    const Eigen::MatrixXd information =
        cov.ldlt().solve(Eigen::MatrixXd::Identity(num_rings, num_rings));
    prior_information_(of_kind, of_kind) = information;
  }
  prior_score_ = prior_information_ * AsUnknowns(known.errors);
}

void BeamCalibration::BeginScan(float path_m, int stands_for) {
  scan_.path_m = path_m;
  scan_.stands_for = stands_for;
  scan_.num_rows = 0;
  const Eigen::Index size = score_.size();
  scan_.information.setZero(size, size);
  scan_.mixed.setZero(kNumNuisance, size);
  scan_.nuisance.setZero();
  scan_.score.setZero(size);
  scan_.nuisance_score.setZero();
}

void BeamCalibration::MakeRoomFor(int num_unknowns) {
  const Eigen::Index before = score_.size();
  if (num_unknowns <= before) return;
  const auto grow = [&](auto& matrix, Eigen::Index rows) {
    matrix.conservativeResize(rows, num_unknowns);
    matrix.rightCols(num_unknowns - before).setZero();
    if (rows == num_unknowns) matrix.bottomRows(num_unknowns - before).setZero();
  };
  grow(information_, num_unknowns);
  grow(prior_information_, num_unknowns);
  for (Eigen::Index i = before; i < num_unknowns; ++i) {
    const double std = AllowanceOf(static_cast<int>(i)).data_sheet_std;
    prior_information_(i, i) = 1.0 / (std * std);
  }
  grow(scan_.information, num_unknowns);
  grow(scan_.mixed, kNumNuisance);
  for (Eigen::VectorXd* vector : {&score_, &prior_score_, &scan_.score}) {
    vector->conservativeResize(num_unknowns);
    vector->tail(num_unknowns - before).setZero();
  }
}

void BeamCalibration::FindTerms(const BeamRow& row) {
  const CellBeams& cell = *row.cell;
  const BeamShift shift = ShiftAlong(row.normal, row.axes);
  terms_.clear();
  terms_.push_back({kCos, shift.azimuth * row.axes.cos_azimuth - cell.cos_azimuth});
  terms_.push_back({kSin, shift.azimuth * row.axes.sin_azimuth - cell.sin_azimuth});
  terms_.push_back({kGrazing, GrazingShift(shift.range) - cell.grazing});
  terms_.push_back({kRelief, row.height_m});
  AddTerms(row.ring, shift, 1.f);
  float num_points = 0.f;
  for (const CellBeams::OfRing& seen : cell.rings) num_points += seen.num_points;
  for (const CellBeams::OfRing& seen : cell.rings) {
    if (seen.num_points == 0) break;
    AddTerms(seen.ring, seen.shift, -seen.num_points / num_points);
  }
}

void BeamCalibration::AddTerms(int ring, const BeamShift& shift, float share) {
  terms_.push_back({RangeOf(ring), share * shift.range});
  terms_.push_back({ElevationOf(ring), share * shift.elevation});
  terms_.push_back({AzimuthOf(ring), share * shift.azimuth});
}

void BeamCalibration::Add(const BeamRow& row) {
  if (row.ring >= kMaxCalibratedRings) return;
  FindTerms(row);
  int num_unknowns = 0;
  for (const Term& term : terms_) num_unknowns = std::max(num_unknowns, term.unknown + 1);
  MakeRoomFor(num_unknowns);
  // The residual without any correction.
  const Eigen::Vector3f correction_m = Displacement(errors_, row.ring, row.axes);
  const double residual_m = row.residual_m + relief_ * row.height_m + row.normal.dot(correction_m) -
                            row.cell->correction_m;
  Nuisance jacobian;
  jacobian.head<6>() = row.jacobian.cast<double>();
  jacobian.tail<6>() =
      (scan_.path_m - row.cell->path_m) / Parameters::kDriftPath_m * jacobian.head<6>();
  const double weight = row.weight;
  scan_.nuisance.selfadjointView<Eigen::Lower>().rankUpdate(jacobian, weight);
  scan_.nuisance_score += weight * residual_m * jacobian;
  for (const Term& a : terms_) {
    const double weighted = weight * a.value;
    scan_.mixed.col(a.unknown) += weighted * jacobian;
    scan_.score[a.unknown] += weighted * residual_m;
    for (const Term& b : terms_) {
      if (b.unknown <= a.unknown) scan_.information(a.unknown, b.unknown) += weighted * b.value;
    }
  }
  ++scan_.num_rows;
}

void BeamCalibration::Keep(double new_content_share, bool is_blind) {
  if (is_frozen_ || scan_.num_rows < Parameters::kMinRows || !(new_content_share > 0.0)) return;
  NuisanceSquare nuisance = scan_.nuisance.selfadjointView<Eigen::Lower>();
  // Keeps a direction that no surface shows from becoming singular.
  nuisance.diagonal().array() += 1e-9 * nuisance.diagonal().maxCoeff();
  nuisance.diagonal().segment<3>(6).array() += 1.0 / Parameters::kMaxDriftVar_m2;
  nuisance.diagonal().segment<3>(9).array() += 1.0 / Parameters::kMaxDriftVar_rad2;
  const NuisanceColumns shift = nuisance.ldlt().solve(scan_.mixed);
  scan_.information.triangularView<Eigen::Lower>() -= scan_.mixed.transpose() * shift;
  const double weight = Parameters::kInformationPerShare * new_content_share * scan_.stands_for;
  information_.triangularView<Eigen::Lower>() += weight * scan_.information;
  score_ += weight * (scan_.score - shift.transpose() * scan_.nuisance_score);
  scan_.num_rows = 0;
  num_blind_ += is_blind ? 1 : 0;
  if (num_kept_++ % Parameters::kSolvePeriod_scans == 0) Solve();
}

std::optional<Matrix6> BeamCalibration::ScoreCov() const {
  const Eigen::Index num_known = posterior_.cols();
  if (scan_.num_rows == 0 || num_known == 0) return std::nullopt;
  const Eigen::Matrix<double, 6, Eigen::Dynamic> score_per_error =
      scan_.stands_for * scan_.mixed.topLeftCorner(6, num_known);
  return Matrix6(score_per_error * posterior_.solve(score_per_error.transpose()));
}

void BeamCalibration::Solve() {
  posterior_.compute(information_ + prior_information_);  // reads the lower triangle
  const Eigen::VectorXd unknowns = posterior_.solve(score_ + prior_score_);
  errors_ = AsBeamErrors(unknowns);
  const Eigen::VectorXd of_relief =
      posterior_.solve(Eigen::VectorXd::Unit(unknowns.size(), kRelief));
  relief_ =
      static_cast<float>(std::clamp(unknowns[kRelief] - std::sqrt(of_relief[kRelief]), 0.0, 1.0));
}

BeamKnowledge BeamCalibration::Found() const {
  const Eigen::Index size = posterior_.cols();
  if (size == 0) return {};
  const Eigen::MatrixXd cov = posterior_.solve(Eigen::MatrixXd::Identity(size, size));
  return {errors_, AsBeamErrors(cov.diagonal().cwiseSqrt())};
}

}  // namespace lio
