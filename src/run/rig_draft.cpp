// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/rig_draft.hpp"

#include <fmt/format.h>

#include "lio/pipeline/options_fields.hpp"

namespace lio {
namespace {

// A reason stands on comment lines of its own above its entry, whatever newlines it has.
std::string Comment(const std::string& text, const std::string& indent) {
  std::string lines = indent + "# ";
  for (const char c : text) {
    if (c == '\n') {
      lines += "\n" + indent + "# ";
    } else {
      lines += c;
    }
  }
  return lines + "\n";
}

std::string ExtrinsicText(const RigDraft& draft) {
  if (!draft.rig.T_imu_lidar) return "";
  const Vector3& t = draft.rig.T_imu_lidar->translation;
  const Quaternion& q = draft.rig.T_imu_lidar->rotation;
  return "  # p_imu = T_imu_lidar * p_lidar: the place of the lidar as seen from the IMU [m], and\n"
         "  # the turn that carries the lidar's axes to the IMU's. The rotation may also be given\n"
         "  # as rotation_rpy_deg or rotation_matrix, all of it as a 4x4 matrix.\n" +
         Comment(draft.extrinsic_reason, "  ") +
         fmt::format(
             "  T_imu_lidar:\n"
             "    translation_m: [{:.6g}, {:.6g}, {:.6g}]\n"
             "    rotation_wxyz: [{:.9g}, {:.9g}, {:.9g}, {:.9g}]\n",
             t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

std::string Lidar(const RigDraft& draft) {
  const LidarRig& lidar = draft.rig.lidar;
  return "  lidar:\n" + Comment(draft.lidar_reason, "    ") +
         fmt::format(
             "    model: {}\n"
             "    min_range_m: {:.6g}   # nearer returns are dropped: the vehicle itself\n"
             "    max_range_m: {:.6g}\n"
             "    clock_offset_s: {:.6g}   # added to the lidar's stamps\n",
             lidar.model, lidar.min_range_m, lidar.max_range_m, lidar.clock_offset_s);
}

std::string Imu(const RigDraft& draft) {
  if (!draft.use_imu) return "";
  const ImuRig& imu = draft.rig.imu;
  return "  imu:\n" + Comment(draft.units_reason, "    ") +
         fmt::format("    units: {}   # or si, g, deg, g_deg\n", EnumName(imu.units)) +
         Comment(draft.gravity_reason, "    ") +
         fmt::format("    gravity: {}   # or present, removed\n", EnumName(imu.gravity)) +
         Comment(draft.noise_reason, "    ") +
         fmt::format(
             "    gyro_noise_density: {:.3g}    # [rad/s/sqrt(Hz)]\n"
             "    accel_noise_density: {:.3g}   # [m/s^2/sqrt(Hz)]\n"
             "    gyro_bias_walk_density: {:.3g}\n"
             "    accel_bias_walk_density: {:.3g}\n",
             imu.gyro_noise_density, imu.accel_noise_density, imu.gyro_bias_walk_density,
             imu.accel_bias_walk_density);
}

}  // namespace

std::string RigDraftYaml(const RigDraft& draft) {
  std::string text =
      Comment("The rig of " + draft.input + ", drafted by lio-run. Correct it and run", "") +
      Comment("  " + draft.command, "");
  for (const std::string& line : draft.about) text += Comment(line, "");
  text += "rig:\n" + ExtrinsicText(draft) + Lidar(draft) + Imu(draft);
  if (draft.use_imu) {
    text += fmt::format("  gravity_mps2: {:.6g}\n", draft.rig.gravity_mps2);
  } else {
    text += "pipeline:\n  use_imu: false   # the recording has no inertial samples\n";
  }
  return text;
}

}  // namespace lio
