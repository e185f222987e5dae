// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "calib/turn_fit.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "calib/calibration_parameters.hpp"
#include "lio/base/so3.hpp"
#include "lio/filter/preintegration.hpp"
#include "lio/filter/sample_lookup.hpp"

namespace lio {
namespace {

constexpr TurnFitParameters kTurnFit = kCalibrationParameters.fit;

// These unknowns are common to all turns, as changes of the state of the round: offset [s],
// rotation [rad, right], gyro bias [rad/s].
constexpr int kNumCommon = 7;

using so3::Exp;
using so3::Log;
using so3::Vec3;

// Holds a turn by gyro at the offset of the round, with its derivatives.
struct GyroTurn {
  Quaternion turn;
  Matrix3 by_bias;             // derivative of the right error
  Vector3 rate_from, rate_to;  // rad/s, bias-corrected: derivatives by the offset
};

GyroTurn TurnByGyro(std::span<const ImuSample> samples, const SweepTurn& turn,
                    const RotationCalibration& state) {
  const Duration offset = Duration::FromSeconds(state.offset_s);
  const Timestamp from = turn.from + offset;
  const Timestamp to = turn.to + offset;
  const Preintegration sum =
      Preintegrate(samples, from, to, {state.gyro_bias_radps, Vector3::Zero()}, {});
  return {sum.rotation, sum.by_bias.block<3, 3>(3, 0),
          SampleAt(samples, from).w_imu_radps - state.gyro_bias_radps,
          SampleAt(samples, to).w_imu_radps - state.gyro_bias_radps};
}

// Gives the term of a turn: the lidar's against the gyro's, given the two sweeps' own errors.
struct TurnError {
  TurnError(const SweepTurn& turn, const GyroTurn& gyro_in, const RotationCalibration& state)
      : R_from_to(turn.R_from_to),
        gyro(gyro_in),
        R_imu_lidar(state.R_imu_lidar),
        std_rad(state.turn_std_rad) {}

  template <class T>
  bool operator()(const T* common, const T* own_from, const T* own_to, T* residual) const {
    using Quat = Eigen::Quaternion<T>;
    using ConstVec3 = Eigen::Map<const Vec3<T>>;
    const T& shift_s = common[0];
    const Vec3<T> bias = ConstVec3(common + 4);
    const Vec3<T> before = -shift_s * (gyro.rate_from.template cast<T>() - bias);
    const Vec3<T> after = shift_s * (gyro.rate_to.template cast<T>() - bias);
    const Vec3<T> by_bias = gyro.by_bias.template cast<T>() * bias;
    const Quat turn_imu =
        Exp<T>(before) * gyro.turn.template cast<T>() * (Exp<T>(by_bias) * Exp<T>(after));
    const Quat R = R_imu_lidar.template cast<T>() * Exp<T>(ConstVec3(common + 1));
    const Quat turn_lidar = R.conjugate() * (turn_imu * R);
    const Quat expected = Exp<T>(-ConstVec3(own_from)) * (turn_lidar * Exp<T>(ConstVec3(own_to)));
    const Quat error = R_from_to.conjugate().template cast<T>() * expected;
    Eigen::Map<Vec3<T>>{residual} = Log<T>(error) / T(std_rad);
    return true;
  }

  Quaternion R_from_to;
  GyroTurn gyro;
  Quaternion R_imu_lidar;
  double std_rad;
};

// Gives the prior of a sweep's own rotation error.
struct OwnError {
  template <class T>
  bool operator()(const T* own, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = own[i] / std_rad;
    return true;
  }
  double std_rad;
};

std::vector<Vector3> Residuals(std::span<const ImuSample> samples, std::span<const SweepTurn> turns,
                               const RotationCalibration& state) {
  std::vector<Vector3> residuals;
  const std::array<double, kNumCommon> none{};
  for (const SweepTurn& turn : turns) {
    TurnError error(turn, TurnByGyro(samples, turn, state), state);
    error.std_rad = 1.0;
    Vector3 residual;
    error(none.data(), none.data(), none.data(), residual.data());
    residuals.push_back(residual);
  }
  return residuals;
}

// Estimates sweep_std and turn_std. A sweep's own error has opposite signs in the turns before and
// after it: the product of neighbouring residuals has the mean -sweep_std^2, the square of one has
// 2 sweep_std^2 + turn_std^2. Residuals far beyond the median are outliers and do not count.
void EstimateNoise(std::span<const SweepTurn> turns, const std::vector<Vector3>& residuals,
                   RotationCalibration& state) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const Vector3& residual : residuals) sizes.push_back(residual.norm());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double limit = kTurnFit.max_residual_ratio * *middle;
  double square = 0.0, product = 0.0;
  int num = 0, num_pairs = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i].norm() > limit) continue;
    square += residuals[i].squaredNorm() / 3.0;
    ++num;
    const bool follows = i > 0 && turns[i].first == turns[i - 1].first + 1;
    if (!follows || residuals[i - 1].norm() > limit) continue;
    product += residuals[i].dot(residuals[i - 1]) / 3.0;
    ++num_pairs;
  }
  square /= std::max(1, num);
  const double sweep_var =
      num_pairs > 0 ? std::clamp(-product / num_pairs, 0.0, 0.5 * square) : 0.0;
  state.sweep_std_rad = std::max(kTurnFit.min_std_rad, std::sqrt(sweep_var));
  state.turn_std_rad =
      std::max({kTurnFit.min_std_rad, std::sqrt(std::max(0.0, square - 2.0 * sweep_var)),
                kTurnFit.min_turn_share * state.sweep_std_rad});
}

// Solves one least squares problem, linearized at the state of the round.
class Round {
 public:
  Round(std::span<const ImuSample> samples, std::span<const SweepTurn> turns,
        const RotationCalibration& state) {
    for (const SweepTurn& turn : turns) {
      auto* cost = new ceres::AutoDiffCostFunction<TurnError, 3, kNumCommon, 3, 3>(
          new TurnError(turn, TurnByGyro(samples, turn, state), state));
      problem_.AddResidualBlock(cost, new ceres::HuberLoss(kTurnFit.huber_sigmas), common_.data(),
                                Own(turn.first, state), Own(turn.first + 1, state));
    }
  }

  [[nodiscard]] bool Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = kTurnFit.max_iterations;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    cost_ = summary.final_cost;
    num_residuals_ = summary.num_residuals;
    return summary.IsSolutionUsable();
  }

  // Adds the solution to the state; true when it has converged.
  [[nodiscard]] bool Apply(RotationCalibration& state) const {
    const Vector3 turn(common_[1], common_[2], common_[3]);
    state.offset_s += common_[0];
    state.R_imu_lidar = (state.R_imu_lidar * ExpSo3(turn)).normalized();
    state.gyro_bias_radps += Vector3(common_[4], common_[5], common_[6]);
    const auto own = static_cast<double>(own_.size());
    state.residual_ratio =
        std::sqrt(2.0 * cost_ / std::max(1.0, num_residuals_ - 3.0 * own - kNumCommon));
    return std::abs(common_[0]) < kTurnFit.converged_s && turn.norm() < kTurnFit.converged_rad;
  }

  [[nodiscard]] bool FillCovariance(RotationCalibration& state) {
    ceres::Covariance covariance(ceres::Covariance::Options{});
    const std::vector<const double*> blocks = {common_.data()};
    if (!covariance.Compute(blocks, &problem_)) return false;
    Eigen::Matrix<double, kNumCommon, kNumCommon, Eigen::RowMajor> cov;
    if (!covariance.GetCovarianceMatrix(blocks, cov.data())) return false;
    cov *= std::max(1.0, state.residual_ratio * state.residual_ratio);
    state.offset_std_s = std::sqrt(cov(0, 0));
    state.rotation_cov = cov.block<3, 3>(1, 1);
    state.gyro_bias_std_radps = cov.diagonal().tail<3>().cwiseSqrt();
    return cov.allFinite();
  }

 private:
  double* Own(std::size_t sweep, const RotationCalibration& state) {
    const auto [at, is_new] = own_.try_emplace(sweep);
    if (is_new) {
      at->second.fill(0.0);
      auto* cost =
          new ceres::AutoDiffCostFunction<OwnError, 3, 3>(new OwnError{state.sweep_std_rad});
      problem_.AddResidualBlock(cost, nullptr, at->second.data());
    }
    return at->second.data();
  }

  ceres::Problem problem_;
  std::array<double, kNumCommon> common_{};
  std::map<std::size_t, std::array<double, 3>>
      own_;  // by sweep; a map, because Ceres keeps the addresses
  double cost_ = 0.0;
  double num_residuals_ = 0.0;
};

}  // namespace

bool FitTurns(std::span<const ImuSample> samples, std::span<const SweepTurn> turns,
              RotationCalibration& state) {
  state.num_turns = static_cast<int>(turns.size());
  for (int i = 0; i < kTurnFit.max_rounds; ++i) {
    if (i < kTurnFit.noise_rounds) EstimateNoise(turns, Residuals(samples, turns, state), state);
    Round round(samples, turns, state);
    if (!round.Solve()) return false;
    if (round.Apply(state) && i + 1 >= kTurnFit.noise_rounds) return round.FillCovariance(state);
  }
  return false;
}

}  // namespace lio
