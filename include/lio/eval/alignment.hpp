// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Moves the estimate's world onto the truth's, and finds a constant rotation between the two body
// frames, which would otherwise pass for a rotation error and spoil every relative figure.
#pragma once

#include <string>

#include "lio/eval/association.hpp"

namespace lio {

enum class AlignMode {
  kNone,  // the files are in one world already
  kYaw,   // turn about z and move: both worlds have z up
  kSe3,   // turn and move
};

struct PathAlignment {
  AlignMode mode = AlignMode::kNone;
  Pose T_truth_estimate;       // p_truth = T_truth_estimate * p_estimate
  bool used_attitude = false;  // the path alone did not fix the rotation: straight, or at rest
  // How far the rotation can be trusted: residual RMS over the path's spread across its main
  // direction. 0 when it came from attitudes.
  double rotation_uncertainty_deg = 0;
};

// Least squares over positions, no scale (Umeyama, TPAMI 13(4), 1991). Where the path leaves the
// rotation open (spread below 5 cm across its main direction; for kYaw in the plane), what is open
// is taken from the attitudes.
PathAlignment Align(const PosePairs& pairs, AlignMode mode);

// R_truth = R_align R_estimate Inverse(rotation), up to noise: `rotation` maps the estimate's body
// axes to the truth's.
struct RotationOffset {
  Quaternion rotation = Quaternion::Identity();  // mean over the pairs
  double angle_deg = 0;
  Vector3 axis = Vector3::UnitZ();
  double scatter_deg = 0;  // RMS angle of single pairs about the mean
  // Above 1 deg, and far above both the scatter and what the alignment leaves open: a frame
  // mistake, not drift.
  bool is_detected = false;
  bool is_removed = false;  // 5 deg and more: relative errors are computed without it
  std::string name;         // in words, e.g. "90.0 deg about z"; empty when not detected
};

// `se3` must be Align(pairs, kSe3): with another alignment a turned world looks like a turned body.
RotationOffset FindRotationOffset(const PosePairs& pairs, const PathAlignment& se3);

// The mean rotation, in the sense of the smallest sum of squared chordal distances (Markley et al.,
// "Averaging quaternions", 2007). At least one.
Quaternion MeanRotation(const std::vector<Quaternion>& rotations);

}  // namespace lio
