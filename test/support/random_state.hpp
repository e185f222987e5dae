// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws random vectors, states and covariances from seeded generators.
#pragma once

#include <Eigen/Cholesky>
#include <random>

#include "lio/filter/nav_state.hpp"

namespace lio::test {

// Returns independent standard normals.
template <int n>
Eigen::Matrix<double, n, 1> RandomVector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, n, 1> vector;
  for (double& x : vector) x = normal(random);
  return vector;
}

// Returns any orientation, metres and metres per second of order one, and biases of order 0.01 and
// 0.1.
inline NavState RandomState(std::mt19937_64& random) {
  NavState state;
  state.T_world_imu = ExpSe3(RandomVector<6>(random));
  state.T_map_imu = ExpSe3(RandomVector<6>(random));
  state.v_world_imu = RandomVector<3>(random);
  state.gyro_bias = 0.01 * RandomVector<3>(random);
  state.accel_bias = 0.1 * RandomVector<3>(random);
  state.R_world_map_start = ExpSo3(RandomVector<3>(random));
  return state;
}

// Returns a symmetric positive definite matrix with all entries correlated and standard deviations
// about `size`.
template <int n>
Eigen::Matrix<double, n, n> RandomCovariance(std::mt19937_64& random, double size) {
  Eigen::Matrix<double, n, n> root;
  for (int i = 0; i < n; ++i) root.col(i) = RandomVector<n>(random);
  return size * size / n * (root * root.transpose()) +
         0.01 * size * size * Eigen::Matrix<double, n, n>::Identity();
}

// Returns a draw from N(0, cov).
template <int n>
Eigen::Matrix<double, n, 1> DrawFrom(const Eigen::Matrix<double, n, n>& cov,
                                     std::mt19937_64& random) {
  const Eigen::LDLT<Eigen::Matrix<double, n, n>> factor(cov);  // takes zero variances as well
  const Eigen::Matrix<double, n, 1> scaled =
      factor.vectorD().cwiseMax(0.0).cwiseSqrt().cwiseProduct(RandomVector<n>(random));
  const Eigen::Matrix<double, n, 1> mixed = factor.matrixL() * scaled;
  return factor.transpositionsP().transpose() * mixed;
}

}  // namespace lio::test
