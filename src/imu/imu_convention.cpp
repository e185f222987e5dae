// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_convention.hpp"

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;  // 1 g by definition (CGPM 1901)

// Returns the axes of the messages along imu's x, y and z, such as "x -y -z".
std::string AxisNames(const Matrix3& R_imu_sent) {
  std::string names;
  for (const auto& row : R_imu_sent.rowwise()) {
    Eigen::Index axis = 0;
    row.cwiseAbs().maxCoeff(&axis);
    names += names.empty() ? "" : " ";
    names += row(axis) < 0.0 ? "-" : "";
    names += "xyz"[axis];
  }
  return names;
}

}  // namespace

double ImuConvention::force_scale() const {
  return is_in_g ? kStandardGravity_mps2 : 1.0;
}

double ImuConvention::rate_scale() const {
  return is_in_deg ? kRadPerDeg : 1.0;
}

// Returns signed permutations of the axes that keep the handedness.
std::array<Matrix3, kNumQuarterTurns> QuarterTurns() {
  std::array<Matrix3, kNumQuarterTurns> turns;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto x = static_cast<Eigen::Index>(i / 8);
    const Eigen::Index y = (x + 1 + (i & 4 ? 1 : 0)) % 3;
    const Vector3 to_x = (i & 1 ? -1.0 : 1.0) * Vector3::Unit(x);
    const Vector3 to_y = (i & 2 ? -1.0 : 1.0) * Vector3::Unit(y);
    turns[i] << to_x.transpose(), to_y.transpose(), to_x.cross(to_y).transpose();
  }
  return turns;
}

ImuSample ToSi(const ImuConvention& convention, ImuSample sent) {
  sent.w_imu_radps = convention.rate_scale() * (convention.R_imu_sent * sent.w_imu_radps);
  sent.f_imu_mps2 = convention.force_scale() * (convention.R_imu_sent * sent.f_imu_mps2);
  sent.made_up_w_std_radps *= static_cast<float>(convention.rate_scale());
  sent.made_up_f_std_mps2 *= static_cast<float>(convention.force_scale());
  return sent;
}

ImuSample FromSi(const ImuConvention& convention, ImuSample sample) {
  sample.w_imu_radps =
      convention.R_imu_sent.transpose() * sample.w_imu_radps / convention.rate_scale();
  sample.f_imu_mps2 =
      convention.R_imu_sent.transpose() * sample.f_imu_mps2 / convention.force_scale();
  return sample;
}

Pose InAxesOfMessages(const Pose& T_imu_lidar, const ImuConvention& convention) {
  const Quaternion R_sent_imu = Quaternion(convention.R_imu_sent).conjugate();
  return {R_sent_imu * T_imu_lidar.rotation, R_sent_imu * T_imu_lidar.translation};
}

ImuConvention ConventionOf(ImuUnits units) {
  ImuConvention convention;
  convention.is_in_g = units == ImuUnits::kG || units == ImuUnits::kGAndDeg;
  convention.is_in_deg = units == ImuUnits::kDeg || units == ImuUnits::kGAndDeg;
  return convention;
}

ImuUnits UnitsOf(const ImuConvention& convention) {
  if (convention.is_in_g) return convention.is_in_deg ? ImuUnits::kGAndDeg : ImuUnits::kG;
  return convention.is_in_deg ? ImuUnits::kDeg : ImuUnits::kSi;
}

std::string Describe(const ImuConvention& convention) {
  std::string text = convention.is_in_g ? "accelerometer in g" : "accelerometer in m/s^2";
  text += convention.is_in_deg ? ", gyro in deg/s" : ", gyro in rad/s";
  if (convention.R_imu_sent == Matrix3::Identity()) return text;
  text += ", its " + AxisNames(convention.R_imu_sent) + " are the rig's x y z";
  if (convention.R_imu_sent(2, 2) < -0.5) text += " (z down)";
  return text;
}

}  // namespace lio
