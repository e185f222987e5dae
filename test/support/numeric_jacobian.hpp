// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Computes central differences, which check analytic Jacobians.
#pragma once

#include <Eigen/Core>

namespace lio::test {

// Returns d f / d x at x, for f: R^n -> R^m given as vectors.
template <typename Function>
Eigen::MatrixXd NumericJacobian(const Function& f, const Eigen::VectorXd& x, double step = 1e-6) {
  const Eigen::VectorXd f0 = f(x);
  Eigen::MatrixXd jacobian(f0.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd plus = x;
    Eigen::VectorXd minus = x;
    plus(i) += step;
    minus(i) -= step;
    jacobian.col(i) = (Eigen::VectorXd(f(plus)) - Eigen::VectorXd(f(minus))) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace lio::test
