// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/pose_event.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lio/filter/estimate_change.hpp"
#include "lio/filter/filter_parameters.hpp"

namespace lio {
namespace {

// Returns the factors after an update: an exponential mean of NIS / 3, the ratio of the
// innovations' variance to its expected value, for translation and rotation; from 1 to `max`. The
// NIS was computed with the inflated covariance, so it is multiplied by the factor `now`.
CovarianceInflation NextInflation(const CovarianceInflation& inflation, const UpdateResult& update,
                                  const CovarianceInflation& max) {
  static constexpr InflationParameters kParameters = kFilterParameters.inflation;
  const auto next = [](double now, double nis, double max_factor) {
    return std::clamp(
        now + kParameters.rate_per_pose * (now * std::min(nis, kParameters.max_nis) / 3.0 - now),
        1.0, max_factor);
  };
  return {next(inflation.translation, update.nis_translation, max.translation),
          next(inflation.rotation, update.nis_rotation, max.rotation)};
}

Matrix6 Inflated(const Matrix6& cov, const CovarianceInflation& inflation) {
  Vector6 scale;
  scale << Vector3::Constant(std::sqrt(inflation.translation)),
      Vector3::Constant(std::sqrt(inflation.rotation));
  return scale.asDiagonal() * cov * scale.asDiagonal();
}

// Returns true when a residual beyond the gate can be so much unseen motion and an error of
// registration, whose covariance was then too small.
bool CanBe(const Vector6& residual, const UnseenMotion& unseen) {
  constexpr ForcedUpdateParameters kParameters = kFilterParameters.forced_update;
  return residual.head<3>().norm() < kParameters.max_registration_error_m + unseen.translation_m &&
         residual.tail<3>().norm() < kParameters.max_registration_error_rad + unseen.rotation_rad;
}

Vector6 ResidualOf(const PoseMeasurement& measurement, const Estimate& estimate) {
  return LogSe3(estimate.state.T_map_imu.Inverse() * measurement.T_map_imu);
}

// The clock was set, so no time has passed for the predicted motion: the poses become uncertain by
// the residual, the velocity does not.
void TakeBackMotion(const Vector6& residual, Estimate& estimate) {
  AllowUnseenMotion(estimate, residual.cwiseAbs2(), Vector3::Zero());
}

// The body has moved by about the residual. Its velocity may have changed by as much or not: it
// becomes uncertain, and the next scans determine it.
void AllowMotionBy(const Vector6& residual, Estimate& estimate) {
  constexpr double kDuration_s = kFilterParameters.forced_update.unseen_motion_s;
  const Vector6 motion_var = residual.cwiseAbs2();
  AllowUnseenMotion(estimate, motion_var, motion_var.head<3>() / (kDuration_s * kDuration_s));
}

// Fuses a pose beyond the gate, unless it must be wrong; `nis` is the value that the gate refused.
bool FuseByForce(PoseMeasurement measurement, const UnseenMotion& max_unseen, double nis,
                 double nis_limit, Estimate& estimate) {
  constexpr UnseenMotion kNone{0.0, 0.0};
  const Vector6 residual = ResidualOf(measurement, estimate);
  if (!CanBe(residual, max_unseen)) return false;
  if (CanBe(residual, kNone)) {
    measurement.cov *= nis / nis_limit;
  } else {
    AllowMotionBy(residual, estimate);
  }
  return FusePose(estimate, measurement, std::numeric_limits<double>::infinity()).fused;
}

}  // namespace

UpdateResult FusePoseEvent(const PoseEvent& event, double nis_limit,
                           const CovarianceInflation& max_inflation, CovarianceInflation& inflation,
                           Estimate& estimate) {
  PoseMeasurement measurement = event.measurement;
  measurement.cov = Inflated(measurement.cov, inflation);
  if (event.motion == PredictedMotion::kReplaced) MoveTo(measurement.T_map_imu, estimate);
  if (event.motion == PredictedMotion::kTakenBack) {
    TakeBackMotion(ResidualOf(measurement, estimate), estimate);
  }
  UpdateResult update = FusePose(estimate, measurement, nis_limit);
  inflation = NextInflation(inflation, update, max_inflation);
  if (!update.fused && event.force) {
    update.fused = FuseByForce(measurement, event.max_unseen, update.nis, nis_limit, estimate);
  }
  if (update.fused) BlendMapPose(estimate, event.measurement);
  return update;
}

}  // namespace lio
