// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// From the fit of a drive (rig_fit.hpp) to what is wrong with the rig: clock offset, rotation and
// lever arm between lidar and IMU, an inverted extrinsic, turned axes, wrong units of the gyro.
//
// An error counts where it is surely beyond the tolerance, on the axes that the motion shows.
// Several errors are named where each explains a share of the contradiction; a lesser one may be
// what the first leaves behind, and is found when the first is mended.
#pragma once

#include <optional>
#include <vector>

#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/verdict/motion_record.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct RigFindingParameters {
  // A careful rig may be off by this, one standard deviation. Beyond one of it the result is
  // doubtful, beyond three of it no trust is left. A rig that says to be known less well
  // (Extrinsic::std_m) is distrusted beyond three of its own. Chosen: an inclinometer, a tape
  // measure, and clocks that are set by network time.
  double rotation_tolerance_deg = 1.0;
  double lever_tolerance_m = 0.03;
  double offset_tolerance_s = 0.005;
  double tolerances_to_distrust = 3.0;
  // Chance that an error which is not there is told for one axis of a drive. The limit is Student's
  // quantile with one degree of freedom less than the fit has clusters of time (as is usual for
  // clustered sandwiches): 5 standard deviations in four minutes, 9 in 25 s, 40 in 8 s. Chosen.
  double false_alarm_probability = 1e-6;
  // The same for the bound of an error: that of three standard deviations. Customary.
  double bound_probability = 2.7e-3;
  // The same for a later look that refines a corrected extrinsic: that of one and a half. Measured:
  // with three a lever arm stayed 4 cm off (docs/experiments/extrinsic.md).
  double refine_probability = 0.13;
  // Below this correlation of turns, gyro and lidar do not tell of one motion: the drive is still,
  // or nothing can be said. As in calib (docs/calibration.md).
  double min_correlation = 0.6;
  // The fit is also tried from the rotation that aligns the turns where that is larger, since the
  // rotation may have several minima. Chosen: linearization holds for less.
  double large_rotation_deg = 10.0;
  // Share of what the first error explains, from which a further one is named. Measured: deskewing
  // with a wrong offset leaves 4 % that look like a lever arm (docs/experiments/verdict.md).
  double min_share_of_first = 0.1;
  // Relative error of the gyro's scale within which a unit is recognised. Chosen: matched turns are
  // a few per cent off, and units are 57 times apart.
  double unit_scale_tolerance = 0.2;
  // How near the inverted extrinsic must be, beyond so many standard deviations. Chosen: deskewing
  // with a wrong rotation leaves so much.
  double inverted_sigmas = 3.0;
  double inverted_within_deg = 3.0;
  double inverted_within_m = 0.1;
};

inline constexpr RigFindingParameters kRigFindings;

// The errors of the rig are at most this, axis by axis of imu, but for bound_probability.
struct RigBounds {
  Vector3 rotation_rad = Vector3::Zero();
  Vector3 lever_m = Vector3::Zero();
  double offset_s = 0.0;
};

// How surely rig.T_imu_lidar is known where the motion has shown it: standard deviations, axis by
// axis of imu.
struct ExtrinsicStd {
  Vector3 rotation_rad = Vector3::Zero();
  Vector3 lever_m = Vector3::Zero();
};

struct RigFindings {
  bool is_checked = false;          // the motion was enough to tell
  std::optional<RigBounds> bounds;  // by the motion, where it was enough to tell
  std::optional<ExtrinsicStd> extrinsic_std;
  std::vector<Cause> causes;  // likeliest first
  // rig.T_imu_lidar as the motion shows it, in the axes that the samples are read in: present where
  // it is surely wrong. Entries that are not surely wrong, or that the rig says to be exact, are
  // the rig's.
  std::optional<Pose> T_imu_lidar;
  // The same within the tolerances, for an extrinsic that was found by an earlier and shorter look:
  // present where this one contradicts it.
  std::optional<Pose> T_imu_lidar_bettered;
};

// `convention`: how the messages are read now, found or stated. `is_lever_found`: the motion has
// shown the translation of rig.T_imu_lidar, which is then in the axes that messages are read in;
// one that was measured is taken to be in the axes of the messages.
[[nodiscard]] RigFindings FindRigErrors(const MotionRecord& record, const Rig& rig,
                                        const ImuConvention& convention,
                                        bool is_lever_found = false);

// YAML for the configuration.
[[nodiscard]] std::string ExtrinsicYaml(const Pose& T_imu_lidar);

}  // namespace lio
