// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "lio/base/angle.hpp"
#include "lio/eval/alignment.hpp"

namespace lio {
namespace {

constexpr double kMinDetected_deg = 1.0;
constexpr double kMinRemoved_deg = 5.0;
constexpr double kMinSigmas = 4.0;
constexpr double kMaxAxisError_deg = 3.0;  // an axis nearer to a named one than this gets its name

// Returns the rotation from camera axes (x right, y down, z forward) to vehicle axes (x forward, y
// left, z up).
Quaternion CameraInVehicle() {
  Matrix3 axes;
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Quaternion(axes);
}

std::string AxisName(const Vector3& axis) {
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis(i)) > std::cos(kMaxAxisError_deg / kDegPerRad)) {
      return axis(i) > 0 ? kNames[i] : std::string("-") + kNames[i];
    }
  }
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", axis.x(), axis.y(), axis.z());
}

std::string Meaning(const RotationOffset& offset) {
  const auto is_near = [&](const Quaternion& known) {
    return offset.rotation.angularDistance(known) * kDegPerRad < kMaxAxisError_deg;
  };
  if (is_near(CameraInVehicle())) {
    return ": the estimate is in camera axes (x right, y down, z forward), the truth in vehicle "
           "axes (x forward, y left, z up)";
  }
  if (is_near(CameraInVehicle().conjugate())) {
    return ": the truth is in camera axes (x right, y down, z forward), the estimate in vehicle "
           "axes (x forward, y left, z up)";
  }
  const bool is_about_z = std::abs(offset.axis.z()) > std::cos(kMaxAxisError_deg / kDegPerRad);
  const double quarter_turns = offset.angle_deg / 90.0;
  const double rest_deg = 90.0 * std::abs(quarter_turns - std::round(quarter_turns));
  if (is_about_z && rest_deg < kMaxAxisError_deg && offset.angle_deg > 45) {
    return ": a body frame turned by quarter turns; check T_imu_lidar or the truth's axes";
  }
  if (offset.angle_deg > 180 - kMaxAxisError_deg) return ": upside down; check z up or down";
  return "";
}

// Near half a turn the sign of the axis is ambiguous: its largest entry is made positive there.
void SetAngleAndAxis(RotationOffset& offset) {
  const Vector3 vector = LogSo3(offset.rotation);
  offset.angle_deg = vector.norm() * kDegPerRad;
  if (vector.norm() > 0) offset.axis = vector.normalized();
  int largest = 0;
  offset.axis.cwiseAbs().maxCoeff(&largest);
  if (offset.angle_deg > 179.0 && offset.axis(largest) < 0) offset.axis = -offset.axis;
}

}  // namespace

RotationOffset FindRotationOffset(const PosePairs& pairs, const PathAlignment& se3) {
  RotationOffset offset;
  // Attitudes that were used for the alignment cannot be evidence of a rotation between the bodies.
  if (se3.used_attitude) return offset;
  std::vector<Quaternion> offsets;
  for (const PosePair& pair : pairs) {
    offsets.push_back(pair.truth.rotation.conjugate() * se3.T_truth_estimate.rotation *
                      pair.estimate.rotation);
  }
  offset.rotation = MeanRotation(offsets);
  double sum_sq = 0;
  for (const Quaternion& single : offsets) {
    const double angle_deg = single.angularDistance(offset.rotation) * kDegPerRad;
    sum_sq += angle_deg * angle_deg;
  }
  offset.scatter_deg = std::sqrt(sum_sq / static_cast<double>(offsets.size()));
  SetAngleAndAxis(offset);
  const double noise_deg = std::max(offset.scatter_deg, se3.rotation_uncertainty_deg);
  offset.is_detected = offset.angle_deg >= std::max(kMinDetected_deg, kMinSigmas * noise_deg);
  offset.is_removed = offset.is_detected && offset.angle_deg >= kMinRemoved_deg;
  if (offset.is_detected) {
    offset.name = fmt::format("{:.1f} deg about {}", offset.angle_deg, AxisName(offset.axis)) +
                  Meaning(offset);
  }
  return offset;
}

}  // namespace lio
