// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/run_errors.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lio/eval/association.hpp"
#include "lio/eval/stamped_csv.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

constexpr double kMinScaledEigenvalue =
    1e-12;  // below this the inverse of a covariance is numerical noise

// Leaves out the rows beyond those of the shorter table, and says so: a kill between the writes of
// two files leaves them.
void CutToShorter(const std::filesystem::path& file, StampedTable& table, StampedPoses& estimate) {
  if (table.rows.size() == estimate.size()) return;
  fmt::print(stderr,
             "{}: has {} rows, its trajectory has {}: the run was killed, and the last rows of the "
             "longer one are left out\n",
             file.string(), table.rows.size(), estimate.size());
  const std::size_t num = std::min(table.rows.size(), estimate.size());
  table.stamps.resize(num);
  table.rows.resize(num);
  estimate.resize(num);
}

std::vector<Matrix6> ReadCovariances(const std::filesystem::path& file, bool is_complete,
                                     StampedPoses& estimate) {
  StampedTable table = ReadStampedCsv(file);
  if (table.columns.size() != 36) {
    throw std::runtime_error(fmt::format("{}:1: has {} columns after t_s, not the 36 of a 6x6",
                                         file.string(), table.columns.size()));
  }
  if (!is_complete) CutToShorter(file, table, estimate);
  if (table.stamps.size() != estimate.size()) {
    throw std::runtime_error(fmt::format("{}: has {} rows, its trajectory has {}", file.string(),
                                         table.stamps.size(), estimate.size()));
  }
  std::vector<Matrix6> covariances;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.stamps[i] != estimate[i].stamp) {
      throw std::runtime_error(fmt::format(
          "{}:{}: its stamp is not that of its trajectory's row {}", file.string(), i + 2, i + 1));
    }
    using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
    const Matrix6 covariance = Eigen::Map<const RowMajor>(table.rows[i].data());
    covariances.push_back(0.5 * (covariance + covariance.transpose()));
  }
  return covariances;
}

StampedPoses ReadStamped(const std::filesystem::path& file) {
  Trajectory trajectory = ReadTrajectory(file);
  if (trajectory.format == TrajectoryFormat::kTum) return std::move(trajectory.poses);
  throw std::runtime_error(file.string() + ": has no stamps; give a TUM file");
}

// Tests the correlation matrix instead of the covariance, so that units do not matter.
bool IsInvertible(const Matrix6& cov) {
  const Vector6 variances = cov.diagonal();
  if (!(variances.array() > 0).all()) return false;
  const Vector6 scale = variances.cwiseSqrt().cwiseInverse();
  const Matrix6 correlation = scale.asDiagonal() * cov * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(correlation, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) > kMinScaledEigenvalue;
}

RunInstant MakeInstant(double time_s, const Pose& truth, const Pose& estimate, const Matrix6& cov) {
  RunInstant instant;
  instant.time_s = time_s;
  const Vector3 rotation_error = LogSo3(estimate.rotation.conjugate() * truth.rotation);
  instant.error << truth.translation - estimate.translation, rotation_error;
  instant.cov = cov;
  Matrix6 to_world = Matrix6::Identity();
  to_world.bottomRightCorner<3, 3>() = estimate.rotation.toRotationMatrix();
  instant.cov_world = to_world * cov * to_world.transpose();
  instant.rotation_error_world = estimate.rotation * rotation_error;
  return instant;
}

// Adds nothing where the covariance of the two angles cannot be inverted.
void AddTilt(const RunInstant& instant, std::vector<TiltSample>& tilts) {
  const Eigen::Matrix2d cov = instant.cov_world.block<2, 2>(3, 3);
  const Eigen::LLT<Eigen::Matrix2d> factor(cov);
  if (factor.info() != Eigen::Success) return;
  const Eigen::Vector2d error = instant.rotation_error_world.head<2>();
  tilts.push_back({instant.time_s, factor.matrixL().solve(error).norm()});
}

}  // namespace

RunFiles LoadRun(const std::filesystem::path& dir, const std::filesystem::path& truth,
                 RunFrame frame) {
  RunFiles run;
  run.name = dir.string();
  const bool has_own_truth = std::filesystem::is_regular_file(dir / truth);
  run.truth = ReadStamped(has_own_truth ? dir / truth : truth);
  const std::string of_frame = frame == RunFrame::kWorld   ? "_world"
                               : frame == RunFrame::kLevel ? "_level"
                                                           : "";
  run.estimate = ReadStamped(dir / ("trajectory" + of_frame + ".tum"));
  const bool is_complete = std::filesystem::exists(dir / "stats.json");
  run.covariances =
      ReadCovariances(dir / ("covariance" + of_frame + ".csv"), is_complete, run.estimate);
  run.is_level = !is_complete || std::filesystem::exists(dir / "trajectory_level.tum");
  const std::filesystem::path registration = dir / "registration.csv";
  run.has_registration = std::filesystem::exists(registration);
  if (!run.has_registration) return run;
  const StampedTable table = ReadStampedCsv(registration, {"fused", "nis"});
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double fused = table.rows[i][0], nis = table.rows[i][1];
    if (fused == 0 || nis <= 0) continue;  // 0: there was no innovation
    run.nis_stamps.push_back(table.stamps[i]);
    run.nis.push_back(nis);
  }
  return run;
}

Pose LevelAlignment(const Pose& truth, const Pose& estimate) {
  const Matrix3 difference = (estimate.rotation * truth.rotation.conjugate()).toRotationMatrix();
  const double yaw =
      std::atan2(difference(1, 0) - difference(0, 1), difference(0, 0) + difference(1, 1));
  const Quaternion turn(Eigen::AngleAxisd(yaw, Vector3::UnitZ()));
  return {turn, estimate.translation - turn * truth.translation};
}

RunErrors ComputeRunErrors(const RunFiles& run) {
  RunErrors result;
  result.name = run.name;
  result.truth_period_s = MedianPeriod(run.truth);
  const double max_gap_s = AutomaticMaxGap(result.truth_period_s);
  std::optional<Pose> T_world_truth;
  for (std::size_t i = 0; i < run.estimate.size(); ++i) {
    const StampedPose& row = run.estimate[i];
    Pose truth;
    if (InterpolateAt(run.truth, row.stamp, max_gap_s, truth) != LookUp::kFound) {
      ++result.num_without_truth;
      continue;
    }
    const bool is_first = !T_world_truth;
    if (is_first) {
      T_world_truth = run.is_level ? LevelAlignment(truth, row.pose) : row.pose * truth.Inverse();
    }
    const double time_s = SecondsBetween(run.estimate.front().stamp, row.stamp);
    const RunInstant instant =
        MakeInstant(time_s, *T_world_truth * truth, row.pose, run.covariances[i]);
    AddTilt(instant, result.tilts);
    if (is_first) continue;
    if (IsInvertible(run.covariances[i])) {
      result.instants.push_back(instant);
    } else {
      ++result.num_singular;
    }
  }
  if (result.instants.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: no row can be judged: {} have no truth at their time, {} have a singular covariance",
        run.name, result.num_without_truth, result.num_singular));
  }
  for (std::size_t i = 0; i < run.nis.size(); ++i) {
    const double time_s = SecondsBetween(run.estimate.front().stamp, run.nis_stamps[i]);
    result.nis.push_back({time_s, run.nis[i]});
  }
  return result;
}

}  // namespace lio
