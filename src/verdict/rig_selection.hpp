// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which of the errors that a fit estimates (rig_fit.hpp) are surely there, and the fit with these
// alone: forward selection among those that are beyond the tolerances.
#pragma once

#include <vector>

#include "lio/verdict/verdict.hpp"
#include "verdict/rig_fit.hpp"

namespace lio {

// So many standard deviations are exceeded by chance with this probability, by Student's t with one
// degree of freedom less than there are clusters.
[[nodiscard]] double SureSigmas(int num_clusters, double probability);
[[nodiscard]] double Sigmas(const Eigen::VectorXd& value, const Eigen::MatrixXd& cov);
// The sure part of a value is that beyond so many standard deviations, axis by axis.
[[nodiscard]] double SurePart(const Eigen::VectorXd& value, const Eigen::MatrixXd& cov,
                              double sure_sigmas);
[[nodiscard]] double AngleDeg(const Quaternion& rotation);

class RigSelection {
 public:
  // One of the errors that the fit estimates, as the full fit has it.
  struct Suspect {
    double in_tolerances = 0.0;  // the sure part of it
    double sigmas = 0.0;
  };

  // `fit` has enough, and these are its turns. Its noise is set from its residuals.
  RigSelection(RigFit& fit, const RigFit::TurnAlignment& turns);

  // The fit with all errors free.
  const RigFitResult& all() const { return all_; }
  // The fit with the selected errors alone.
  const RigFitResult& solution() const { return solution_; }
  // The likeliest comes first.
  const std::vector<CauseKind>& selected() const { return selected_; }
  [[nodiscard]] bool IsSelected(CauseKind kind) const;
  // `kind` is rotation, clock offset or lever arm.
  [[nodiscard]] Suspect Judge(CauseKind kind) const;

 private:
  void FitAll(RigFit& fit, const RigFit::TurnAlignment& turns);
  [[nodiscard]] RigFitResult SolveWith(const RigFit& fit,
                                       const std::vector<CauseKind>& kinds) const;
  void Select(const RigFit& fit);

  RigFitResult all_;
  double sure_sigmas_ = 0.0;
  RigFitResult solution_;
  std::vector<CauseKind> selected_;
};

}  // namespace lio
