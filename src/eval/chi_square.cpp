// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/chi_square.hpp"

#include "lio/base/chi_square.hpp"

namespace lio {

Band MeanBandPerDof(int dof, int num_runs) {
  constexpr double kTail = 0.025;
  const double total_dof = static_cast<double>(dof) * num_runs;
  return {ChiSquareQuantile(kTail, total_dof) / total_dof,
          ChiSquareQuantile(1 - kTail, total_dof) / total_dof};
}

}  // namespace lio
