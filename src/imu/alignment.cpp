// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "imu/alignment.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>

#include "lio/base/so3.hpp"

namespace lio {
namespace {

constexpr AlignmentParameters kAlignment = kInitializationParameters.alignment;

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using ConstVec3 = Eigen::Map<const Vec3<T>>;
template <class T>
using ConstQuat = Eigen::Map<const Eigen::Quaternion<T>>;
using so3::Exp;
using so3::Log;

// Holds rotations with errors on the right, as everywhere in this project.
struct RightError {
  template <class T>
  bool Plus(const T* x, const T* delta, T* out) const {
    Eigen::Map<Eigen::Quaternion<T>>{out} = ConstQuat<T>(x) * Exp<T>(Vec3<T>(ConstVec3<T>(delta)));
    return true;
  }
  template <class T>
  bool Minus(const T* y, const T* x, T* out) const {
    Eigen::Map<Vec3<T>>{out} =
        Log<T>(Eigen::Quaternion<T>(ConstQuat<T>(x).conjugate() * ConstQuat<T>(y)));
    return true;
  }
};

template <int kSize>
Eigen::Matrix<double, kSize, kSize> Whitener(const Eigen::Matrix<double, kSize, kSize>& cov) {
  return cov.llt().matrixL().solve(Eigen::Matrix<double, kSize, kSize>::Identity());
}

// Gives the term of a matched pose: position error in imu, rotation error on the right.
struct PoseTerm {
  explicit PoseTerm(const MatchedPose& pose)
      : T_any_imu(pose.T_any_imu), whiten(Whitener<6>(pose.cov)) {}

  template <class T>
  bool operator()(const T* rotation, const T* position, T* residual) const {
    const Eigen::Quaternion<T> matched_inverse = T_any_imu.rotation.conjugate().template cast<T>();
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = matched_inverse * Vec3<T>(ConstVec3<T>(position) -
                                                         T_any_imu.translation.template cast<T>());
    error.template tail<3>() = Log<T>(matched_inverse * ConstQuat<T>(rotation));
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residual} = whiten.template cast<T>() * error;
    return true;
  }

  Pose T_any_imu;
  Matrix6 whiten;
};

// Gives the term of the preintegrated samples between two states (Forster et al., TRO 2017, section
// VI).
struct MotionTerm {
  MotionTerm(const Preintegration& motion_in, double gravity_mps2)
      : motion(motion_in), gravity(gravity_mps2), whiten(Whitener<9>(motion_in.cov)) {}

  template <class T>
  bool operator()(const T* rotation0, const T* position0, const T* velocity0, const T* rotation1,
                  const T* position1, const T* velocity1, const T* biases, const T* up,
                  T* residual) const {
    const Eigen::Quaternion<T> R0_inverse = ConstQuat<T>(rotation0).conjugate();
    const T t(motion.span_s());
    const Vec3<T> g_t = ConstVec3<T>(up) * (-T(gravity) * t);
    const ConstVec3<T> v0(velocity0);
    const Vec3<T> shift =
        ConstVec3<T>(position1) - ConstVec3<T>(position0) - v0 * t - g_t * (T(0.5) * t);
    const Vec3<T> gain = ConstVec3<T>(velocity1) - v0 - g_t;

    const Eigen::Map<const Eigen::Matrix<T, 6, 1>> bias(biases);
    Eigen::Matrix<T, 6, 1> change = bias;
    change.template head<3>() -= motion.gyro_bias.template cast<T>();
    change.template tail<3>() -= motion.accel_bias.template cast<T>();
    const Eigen::Matrix<T, 9, 1> by_bias = motion.by_bias.template cast<T>() * change;
    const Eigen::Quaternion<T> turn =
        motion.rotation.template cast<T>() * Exp<T>(Vec3<T>(by_bias.template segment<3>(3)));

    Eigen::Matrix<T, 9, 1> error;
    error.template head<3>() =
        R0_inverse * shift - motion.position.template cast<T>() - by_bias.template head<3>();
    error.template segment<3>(3) =
        Log<T>(turn.conjugate() * (R0_inverse * ConstQuat<T>(rotation1)));
    error.template tail<3>() =
        R0_inverse * gain - motion.velocity.template cast<T>() - by_bias.template tail<3>();
    Eigen::Map<Eigen::Matrix<T, 9, 1>>{residual} = whiten.template cast<T>() * error;
    return true;
  }

  Preintegration motion;
  double gravity;
  Eigen::Matrix<double, 9, 9> whiten;
};

// Gives the prior of the biases: zero mean, the rig's turn-on spread.
struct BiasTerm {
  template <class T>
  bool operator()(const T* biases, T* residual) const {
    for (int i = 0; i < 6; ++i) residual[i] = biases[i] / T(i < 3 ? gyro_std : accel_std);
    return true;
  }
  double gyro_std;
  double accel_std;
};

// Holds the unknowns, laid out for Ceres.
class Unknowns {
 public:
  explicit Unknowns(const Alignment& guess) : at_(guess) {
    biases_ << guess.biases.gyro, guess.biases.accel;
  }
  double* Rotation(std::size_t i) { return at_.states[i].R_any_imu.coeffs().data(); }
  double* Position(std::size_t i) { return at_.states[i].p_any_imu.data(); }
  double* Velocity(std::size_t i) { return at_.states[i].v_any_imu.data(); }
  double* BiasBlock() { return biases_.data(); }
  double* Up() { return at_.up_any.data(); }

  Alignment Take() {
    at_.biases = {biases_.head<3>(), biases_.tail<3>()};
    return at_;
  }

 private:
  Alignment at_;
  Vector6 biases_;
};

struct Problem {
  ceres::Problem ceres;
  std::vector<ceres::ResidualBlockId> pose_terms;
};

void AddTerms(const AlignmentTerms& terms, Unknowns& x, Problem& problem) {
  using PoseCost = ceres::AutoDiffCostFunction<PoseTerm, 6, 4, 3>;
  using MotionCost = ceres::AutoDiffCostFunction<MotionTerm, 9, 4, 3, 3, 4, 3, 3, 6, 3>;
  using BiasCost = ceres::AutoDiffCostFunction<BiasTerm, 6, 6>;
  ceres::Problem& c = problem.ceres;
  const std::size_t num = terms.poses.size();
  for (std::size_t i = 0; i <= num; ++i) {
    c.AddParameterBlock(x.Rotation(i), 4, new ceres::AutoDiffManifold<RightError, 4, 3>);
  }
  for (std::size_t i = 0; i < num; ++i) {
    c.AddResidualBlock(new MotionCost(new MotionTerm(terms.motions[i], terms.gravity_mps2)),
                       nullptr, x.Rotation(i), x.Position(i), x.Velocity(i), x.Rotation(i + 1),
                       x.Position(i + 1), x.Velocity(i + 1), x.BiasBlock(), x.Up());
    problem.pose_terms.push_back(c.AddResidualBlock(new PoseCost(new PoseTerm(terms.poses[i])),
                                                    new ceres::HuberLoss(kAlignment.huber_sigmas),
                                                    x.Rotation(i + 1), x.Position(i + 1)));
  }
  c.AddResidualBlock(
      new BiasCost(new BiasTerm{terms.gyro_bias_std_radps, terms.accel_bias_std_mps2}), nullptr,
      x.BiasBlock());
  if (terms.gravity_mps2 > 0) {
    c.SetManifold(x.Up(), new ceres::SphereManifold<3>);
  } else {
    c.SetParameterBlockConstant(x.Up());
  }
}

// Returns the covariance of the first state, biases and vertical, by Ceres: their part of the
// inverse Hessian.
AlignedCov LeadingCovariance(Problem& problem, Unknowns& x, bool has_up) {
  std::vector<const double*> blocks = {x.Rotation(0), x.Velocity(0), x.BiasBlock()};
  if (has_up) blocks.push_back(x.Up());
  ceres::Covariance::Options options;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  const int num_tangent = kAlignedUp + (has_up ? 2 : 0);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> cov(num_tangent,
                                                                             num_tangent);
  if (!covariance.Compute(blocks, &problem.ceres) ||
      !covariance.GetCovarianceMatrixInTangentSpace(blocks, cov.data())) {
    return AlignedCov::Constant(NAN);
  }
  Eigen::Matrix<double, 15, Eigen::Dynamic> from_tangent =
      Eigen::Matrix<double, 15, Eigen::Dynamic>::Zero(15, num_tangent);
  from_tangent.topLeftCorner<kAlignedUp, kAlignedUp>().setIdentity();
  if (has_up) {
    Eigen::Matrix<double, 3, 2, Eigen::RowMajor> up_by_tangent;
    ceres::SphereManifold<3>().PlusJacobian(x.Up(), up_by_tangent.data());
    from_tangent.bottomRightCorner<3, 2>() = up_by_tangent;
  }
  return from_tangent * cov * from_tangent.transpose();
}

}  // namespace

AlignmentResult Align(const AlignmentTerms& terms, const Alignment& guess) {
  Unknowns x(guess);
  Problem problem;
  AddTerms(terms, x, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kAlignment.max_iterations;
  options.function_tolerance = kAlignment.function_tolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem.ceres, &summary);

  AlignmentResult result;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  const bool has_up = terms.gravity_mps2 > 0;
  if (result.converged) result.cov = LeadingCovariance(problem, x, has_up);
  for (const ceres::ResidualBlockId term : problem.pose_terms) {
    double cost = 0.0;
    problem.ceres.EvaluateResidualBlock(term, false, &cost, nullptr, nullptr);
    result.pose_residual_sq.push_back(2.0 * cost);
  }
  result.solution = x.Take();
  return result;
}

}  // namespace lio
