// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/pose_feed.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "lio/filter/filter_history.hpp"
#include "lio/filter/preintegration.hpp"
#include "support/map_is_world.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio::test {
namespace {

// A larger fourth difference of the true positions means that the truth jumps: 50 ms of motion
// leave half a millimetre.
constexpr double kTruthJump_m = 0.005;

std::vector<Vector3> GyroBiases(const RealDrive& drive) {
  constexpr std::size_t kHalfWindow = 100;
  const StampedPoses& poses = drive.T_world_imu;
  std::vector<Vector3> sums(1, Vector3::Zero());  // sums of each step's excess turn
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Timestamp from = poses[i - 1].stamp;
    const Timestamp to = poses[i].stamp;
    const Quaternion measured = Preintegrate(drive.samples, from, to, {}, {}).rotation;
    const Quaternion turn = poses[i - 1].pose.rotation.conjugate() * poses[i].pose.rotation;
    sums.push_back(sums.back() + LogSo3(turn.conjugate() * measured) / SecondsBetween(from, to));
  }
  std::vector<Vector3> biases;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::size_t first = i < kHalfWindow ? 0 : i - kHalfWindow;
    const std::size_t last = std::min(i + kHalfWindow, poses.size() - 1);
    biases.emplace_back((sums[last] - sums[first]) / static_cast<double>(last - first));
  }
  return biases;
}

// Runs the filter once over a drive, in the order of arrival.
class Pass {
 public:
  Pass(const RealDrive& drive, const FeedSettings& settings)
      : drive_(drive), settings_(settings), truth_(Differentiate(drive)), random_(settings.seed) {
    while (!truth_[next_truth_].is_sound) ++next_truth_;
    while (drive_.samples[next_sample_].stamp < truth_[next_truth_].stamp) ++next_sample_;
    HistoryOptions options;
    options.noise = settings.imu;
    options.max_inflation = {1.0, 1.0};  // white poses
    history_.emplace(options, Start(truth_[next_truth_]), drive_.samples[next_sample_]);
    next_pose_ = ++next_truth_;
  }

  FeedFigures Run() {
    for (++next_sample_; next_sample_ < drive_.samples.size(); ++next_sample_) {
      const Timestamp now = drive_.samples[next_sample_].stamp;
      for (; next_pose_ < truth_.size() && truth_[next_pose_].stamp + kFedPoseDelay <= now;
           next_pose_ += 2) {
        Deliver(truth_[next_pose_]);
      }
      (void)history_->AddImu(drive_.samples[next_sample_]);
      for (; next_truth_ < truth_.size() && truth_[next_truth_].stamp <= now; ++next_truth_) {
        Judge(truth_[next_truth_]);
      }
    }
    Average();
    return figures_;
  }

 private:
  Estimate Start(const TrueState& truth) {
    Estimate start;
    start.stamp = truth.stamp;
    start.state.T_world_imu = truth.T_world_imu;
    start.state.v_world_imu = truth.v_world_imu;
    ErrorVector std = ErrorVector::Zero();
    std.segment<3>(kPos).setConstant(kFedPoseStd_m);
    std.segment<3>(kRot).setConstant(kFedPoseStd_rad);
    std.segment<3>(kVel).setConstant(0.1);
    std.segment<3>(kGyroBias).setConstant(0.1);
    std.segment<3>(kAccelBias).setConstant(0.3);
    start.cov = std.cwiseAbs2().asDiagonal();
    ErrorVector error = std.cwiseProduct(RandomVector<kStateDim>(random_));
    error.segment<6>(kGyroBias).setZero();  // the gyro biases are the recording's own
    start.state = BoxPlus(start.state, error);
    MakeMapTheWorld(start);
    return start;
  }

  void Deliver(const TrueState& truth) {
    Vector6 std;
    std << Vector3::Constant(kFedPoseStd_m), Vector3::Constant(kFedPoseStd_rad);
    PoseEvent event;
    event.measurement.T_map_imu =
        truth.T_world_imu * ExpSe3(std.cwiseProduct(RandomVector<6>(random_)));
    event.measurement.cov = std.cwiseAbs2().asDiagonal();
    // The rotations get 20 deg of standard deviation.
    if (!settings_.believes_rotations) event.measurement.cov.bottomRightCorner<3, 3>() *= 1e4;
    event.force = true;  // the filter is never lost: no pose is refused for good
    UpdateResult update;
    const EventOutcome outcome = history_->AddPose(truth.stamp, event, &update);
    ++figures_.num_poses;
    figures_.nis_per_dof += update.nis / 6;
    if (outcome == EventOutcome::kGated) ++figures_.num_gated;
  }

  void Judge(const TrueState& truth) {
    const Estimate estimate = history_->At(truth.stamp);
    figures_.accel_bias = estimate.state.accel_bias;
    const Pose apart = estimate.state.T_world_imu.Inverse() * estimate.state.T_map_imu;
    figures_.apart_m = std::max(figures_.apart_m, apart.translation.norm());
    if (SecondsBetween(history_->start_stamp(), truth.stamp) < kSettle_s) return;
    if (!truth.is_sound) {
      ++figures_.num_unsound;
      return;
    }
    NavState true_state = estimate.state;
    true_state.T_world_imu = truth.T_world_imu;
    true_state.v_world_imu = truth.v_world_imu;
    true_state.gyro_bias = truth.gyro_bias_radps;
    const ErrorVector error = BoxMinus(true_state, estimate.state);
    const auto nees = [&](int at) {
      const Matrix3 cov = estimate.cov.block<3, 3>(at, at);
      return error.segment<3>(at).dot(cov.ldlt().solve(error.segment<3>(at))) / 3;
    };
    figures_.nees_per_dof.position += nees(kPos);
    figures_.nees_per_dof.rotation += nees(kRot);
    figures_.nees_per_dof.velocity += nees(kVel);
    figures_.nees_per_dof.gyro_bias += nees(kGyroBias);
    figures_.rmse.position += error.segment<3>(kPos).squaredNorm();
    figures_.rmse.rotation += error.segment<3>(kRot).squaredNorm();
    figures_.rmse.velocity += error.segment<3>(kVel).squaredNorm();
    figures_.rmse.gyro_bias += error.segment<3>(kGyroBias).squaredNorm();
    ++figures_.num;
  }

  void Average() {
    FeedFigures& f = figures_;
    f.nis_per_dof /= f.num_poses;
    for (double* sum : {&f.nees_per_dof.position, &f.nees_per_dof.rotation,
                        &f.nees_per_dof.velocity, &f.nees_per_dof.gyro_bias}) {
      *sum /= f.num;
    }
    for (double* sum : {&f.rmse.position, &f.rmse.rotation, &f.rmse.velocity, &f.rmse.gyro_bias}) {
      *sum = std::sqrt(*sum / f.num);
    }
    f.worst_velocity_mps = f.rmse.velocity;
  }

  const RealDrive& drive_;
  FeedSettings settings_;
  std::vector<TrueState> truth_;
  std::mt19937_64 random_;
  std::optional<FilterHistory> history_;
  std::size_t next_sample_ = 0, next_truth_ = 0, next_pose_ = 0;
  FeedFigures figures_;
};

}  // namespace

std::vector<TrueState> Differentiate(const RealDrive& drive) {
  const StampedPoses& poses = drive.T_world_imu;
  const std::vector<Vector3> gyro_biases = GyroBiases(drive);
  std::vector<TrueState> states;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    TrueState state{poses[i].stamp, poses[i].pose, Vector3::Zero(), gyro_biases[i], false};
    if (i >= 2 && i + 2 < poses.size()) {
      const auto p = [&](std::size_t k) -> const Vector3& { return poses[k].pose.translation; };
      const double step_s = SecondsBetween(poses[i - 2].stamp, poses[i + 2].stamp) / 4;
      state.v_world_imu = (p(i - 2) - p(i + 2) + 8.0 * (p(i + 1) - p(i - 1))) / (12.0 * step_s);
      const Vector3 fourth = p(i - 2) + p(i + 2) - 4.0 * (p(i - 1) + p(i + 1)) + 6.0 * p(i);
      state.is_sound = fourth.norm() < kTruthJump_m;
    }
    states.push_back(state);
  }
  return states;
}

FeedFigures FeedPoses(const RealDrive& drive, const FeedSettings& settings) {
  return Pass(drive, settings).Run();
}

}  // namespace lio::test
