// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Aligns the estimate's world with the truth's, and finds a constant rotation between the two body
// frames, which would otherwise count as a rotation error and spoil every relative figure.
#pragma once

#include <string>

#include "lio/eval/association.hpp"

namespace lio {

enum class AlignMode {
  kNone,  // no alignment: the files are in one world already
  kYaw,   // turn about z and shift: both worlds have z up
  kSe3,   // turn about any axis and shift
};

struct PathAlignment {
  AlignMode mode = AlignMode::kNone;
  Pose T_truth_estimate;  // p_truth = T_truth_estimate * p_estimate
  bool used_attitude =
      false;  // the path alone did not fix the rotation: it is straight, or at rest
  // The rotation is uncertain by this: residual RMS over the path's spread across its main
  // direction. It is 0 when the rotation came from attitudes.
  double rotation_uncertainty_deg = 0;
};

// Minimizes the squared position errors without scale (Umeyama, TPAMI 13(4), 1991). When the path
// does not determine the whole rotation (its spread across its main direction is below 5 cm; for
// kYaw: in the plane), the open part is taken from the attitudes.
[[nodiscard]] PathAlignment Align(const PosePairs& pairs, AlignMode mode);

// Holds the constant rotation between the body frames: R_truth = R_align R_estimate
// Inverse(rotation), up to noise; `rotation` maps the estimate's body axes to the truth's.
struct RotationOffset {
  Quaternion rotation = Quaternion::Identity();  // mean over the pairs
  double angle_deg = 0;
  Vector3 axis = Vector3::UnitZ();
  double scatter_deg = 0;  // RMS angle of single pairs relative to the mean
  // True above 1 deg, when the angle is also far above the scatter and above what the alignment
  // leaves open: this is a frame mistake, not drift.
  bool is_detected = false;
  bool is_removed = false;  // 5 deg and more: relative errors are computed without it
  std::string name;         // in words, e.g. "90.0 deg about z"; empty when not detected
};

// `se3` must be Align(pairs, kSe3): with another alignment a turned world looks like a turned body.
[[nodiscard]] RotationOffset FindRotationOffset(const PosePairs& pairs, const PathAlignment& se3);

// Returns the rotation with the smallest sum of squared chordal distances (Markley et al.,
// "Averaging quaternions", 2007). At least one rotation is required.
[[nodiscard]] Quaternion MeanRotation(const std::vector<Quaternion>& rotations);

}  // namespace lio
