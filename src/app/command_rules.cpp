// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/command_rules.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace lio {
namespace {

// Arithmetic: a float of a cloud still resolves 8 mm there, as in a map that is loaded.
constexpr double kMaxPosition_m = 100e3;
// Chosen: quaternions that were rounded or typed by hand, and none that was left out.
constexpr double kMaxNormError = 0.01;
constexpr std::size_t kMaxFileName = 64;  // chosen

std::string WhyUnusablePose(const Command& command) {
  const Pose& pose = command.T_world_imu;
  if (!pose.translation.allFinite() || !(pose.translation.norm() < kMaxPosition_m)) {
    return "pos is not finite or more than 100 km from the origin";
  }
  if (!(std::abs(pose.rotation.norm() - 1.0) < kMaxNormError)) {
    return "quat (w, x, y, z) is not of length 1";
  }
  if (!command.pose_cov) return {};
  const Matrix6& cov = *command.pose_cov;
  if (!cov.allFinite() || (cov - cov.transpose()).norm() > 1e-9 * cov.norm()) {
    return "pose_cov is not finite or not symmetric";
  }
  const double least = Eigen::SelfAdjointEigenSolver<Matrix6>(cov).eigenvalues()[0];
  if (least < -1e-9 * cov.norm()) return "pose_cov has a negative variance";
  return {};
}

std::string WhyUnusableName(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  };
  const bool is_cloud = name.ends_with(".pcd") || name.ends_with(".ply");
  const bool is_name = name.size() > 4 && name.size() <= kMaxFileName && name.front() != '.' &&
                       std::all_of(name.begin(), name.end(), is_plain);
  if (is_cloud && is_name) return {};
  return "name must be a file name of letters, digits, '.', '-' and '_' that ends with .pcd or "
         ".ply";
}

}  // namespace

std::string WhyUnusable(const Command& command) {
  const auto action = static_cast<int>(command.action);
  if (action < 0 || action >= kNumCommandActions) return fmt::format("no action is {}", action);
  if (command.action == CommandAction::kResetAtPose) return WhyUnusablePose(command);
  if (command.action == CommandAction::kSaveMap) return WhyUnusableName(command.name);
  return {};
}

GivenPose PoseOf(const Command& command) {
  GivenPose pose{command.T_world_imu, command.pose_cov.value_or(Matrix6::Zero())};
  pose.T_world_imu.rotation.normalize();
  return pose;
}

}  // namespace lio
