// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/base/angle.hpp"
#include "verdict/rig_selection.hpp"

namespace lio {
namespace {

double InTolerances(const Vector3& turn_rad, const Vector3& lever_m) {
  return std::hypot(kDegPerRad * turn_rad.norm() / kRigFindings.rotation_tolerance_deg,
                    lever_m.norm() / kRigFindings.lever_tolerance_m);
}

std::optional<Cause> JudgeUnits(const RigFit::TurnAlignment& turns) {
  const auto is_near = [&](double scale) {
    return std::abs(turns.ratio / scale - 1.0) < kRigFindings.unit_scale_tolerance;
  };
  const bool is_in_deg = is_near(1.0 / kDegPerRad);
  if (!is_in_deg && !is_near(kDegPerRad)) return std::nullopt;
  return Cause{CauseKind::kImuUnits, Trust::kNo, 0.0,
               fmt::format("the lidar turns {:.3g} times as far as the gyro says: its rates are "
                           "in {}",
                           turns.ratio, is_in_deg ? "deg/s" : "rad/s"),
               "rig:\n  imu:\n    units: auto\n"};
}

// The causes that a selection of errors stands for.
class Naming {
 public:
  Naming(const RigSelection& selection, const Rig& rig, const ImuConvention& convention,
         bool is_lever_found, double clock_correction_s)
      : selection_(selection),
        rig_(rig),
        R_imu_sent_(Quaternion(convention.R_imu_sent)),
        is_lever_found_(is_lever_found),
        clock_correction_s_(clock_correction_s) {}

  RigFindings Name() const {
    RigFindings findings;
    findings.is_checked = true;
    findings.bounds = Bounds();
    const RigVector std = Std();
    findings.extrinsic_std = {std.segment<3>(kRigRotation), std.segment<3>(kRigLever)};
    NameInverted(findings.causes);
    for (const CauseKind kind : selection_.selected()) findings.causes.push_back(MakeCause(kind));
    NameAxes(findings.causes);
    findings.T_imu_lidar =
        WithoutErrors(solution_, selection_.IsSelected(CauseKind::kExtrinsicRotation),
                      selection_.IsSelected(CauseKind::kLeverArm));
    findings.T_imu_lidar_bettered = Bettered();
    return findings;
  }

 private:
  // The rotation from the axes of the messages to those that the rig makes of the lidar's.
  Quaternion R_rig_sent() const { return solution_.errors.rotation * R_imu_sent_; }
  Extrinsic T_configured() const { return rig_.T_imu_lidar.value_or(Extrinsic{}); }

  // rig.T_imu_lidar in axes that R_rig_axes turns into its own, without a lever arm that it lacks.
  Pose InAxes(const Quaternion& R_rig_axes, const Vector3& lever_m) const {
    const Pose T = T_configured();
    const Quaternion back = R_rig_axes.conjugate();
    return {(back * T.rotation).normalized(), back * (T.translation + lever_m)};
  }

  // The extrinsic that the fit asks for, in the axes of the messages. The translation is that of
  // the rig, but for a lever arm that was found.
  Pose Corrected() const {
    if (selection_.IsSelected(CauseKind::kLeverArm)) {
      return InAxes(R_rig_sent(), solution_.errors.lever_m);
    }
    if (is_lever_found_) return InAxes(R_rig_sent(), Vector3::Zero());
    return {InAxes(R_rig_sent(), Vector3::Zero()).rotation, T_configured().translation};
  }

  // In the axes that the samples are read in. The translation is the rig's, as above, and so is
  // what the rig says to be exact.
  std::optional<Pose> WithoutErrors(const RigFitResult& fit, bool rotation, bool lever) const {
    rotation = rotation && T_configured().std_deg > 0.0;
    lever = lever && T_configured().std_m > 0.0;
    if (!rotation && !lever) return std::nullopt;
    const Quaternion R_rig_read = rotation ? fit.errors.rotation : Quaternion::Identity();
    if (lever) return InAxes(R_rig_read, fit.errors.lever_m);
    return Pose{InAxes(R_rig_read, Vector3::Zero()).rotation, T_configured().translation};
  }

  std::optional<Pose> Bettered() const {
    const double sigmas = SureSigmas(all_.num_clusters, kRigFindings.refine_probability);
    const auto is_off = [&](const Vector3& value, int at) {
      return SurePart(value, all_.cov.block<3, 3>(at, at), sigmas) > 0.0;
    };
    return WithoutErrors(all_, is_off(LogSo3(all_.errors.rotation), kRigRotation),
                         is_off(all_.errors.lever_m, kRigLever));
  }

  RigVector Std() const { return all_.cov.diagonal().cwiseSqrt(); }

  RigBounds Bounds() const {
    const double sigmas = SureSigmas(all_.num_clusters, kRigFindings.bound_probability);
    const RigVector margin = sigmas * Std();
    const RigErrors& errors = all_.errors;
    return {LogSo3(errors.rotation).cwiseAbs() + margin.segment<3>(kRigRotation),
            errors.lever_m.cwiseAbs() + margin.segment<3>(kRigLever),
            std::abs(errors.offset_s) + margin[kRigOffset]};
  }

  // If the inverse of the rig's R_a, t_a is the truth, the rotation is R_a R_a and the lever arm
  // -R_a t_a - t_a.
  void NameInverted(std::vector<Cause>& causes) const {
    const Pose T = T_configured();
    const Quaternion rotation = T.rotation * T.rotation;
    const Vector3 lever = -(T.rotation * T.translation) - T.translation;
    const bool differs =
        InTolerances(LogSo3(rotation), lever) > kRigFindings.tolerances_to_distrust;
    const bool is_suspect = !selection_.selected().empty() || AngleDeg(R_imu_sent_) > 1.0;
    if (!differs || !is_suspect) return;
    const Quaternion found = all_.errors.rotation * R_imu_sent_;
    const Vector3 turn_off = LogSo3(found.conjugate() * rotation);
    const Vector3 lever_off = all_.errors.lever_m - lever;
    const Matrix3 turn_cov = all_.cov.block<3, 3>(kRigRotation, kRigRotation);
    const Matrix3 lever_cov = all_.cov.block<3, 3>(kRigLever, kRigLever);
    const double sigmas_off = kRigFindings.inverted_sigmas;
    if (kDegPerRad * SurePart(turn_off, turn_cov, sigmas_off) > kRigFindings.inverted_within_deg ||
        SurePart(lever_off, lever_cov, sigmas_off) > kRigFindings.inverted_within_m ||
        2.0 * InTolerances(turn_off, lever_off) >
            InTolerances(LogSo3(found), all_.errors.lever_m)) {
      return;  // not near, or the rig as it stands is about as near
    }
    const double sigmas = std::max(selection_.Judge(CauseKind::kExtrinsicRotation).sigmas,
                                   selection_.Judge(CauseKind::kLeverArm).sigmas);
    causes.push_back(
        {CauseKind::kExtrinsicInverted, Trust::kNo, sigmas,
         fmt::format("the inverse of rig.T_imu_lidar fits the motion within {:.1f} deg "
                     "and {:.2f} m; as it stands it is off by {:.1f} deg and {:.2f} m",
                     kDegPerRad * turn_off.norm(), lever_off.norm(), AngleDeg(found),
                     all_.errors.lever_m.norm()),
         ExtrinsicYaml(T.Inverse())});
  }

  // In tolerances, or in what the rig says to be one standard deviation where that is more.
  double DistrustedFrom(CauseKind kind) const {
    double stds = 1.0;
    if (kind == CauseKind::kExtrinsicRotation) {
      stds = std::max(stds, T_configured().std_deg / kRigFindings.rotation_tolerance_deg);
    } else if (kind == CauseKind::kLeverArm) {
      stds = std::max(stds, T_configured().std_m / kRigFindings.lever_tolerance_m);
    }
    return kRigFindings.tolerances_to_distrust * stds;
  }

  Cause MakeCause(CauseKind kind) const {
    const RigSelection::Suspect suspect = selection_.Judge(kind);
    Cause cause{kind, Trust::kDoubtful, suspect.sigmas, "", ""};
    if (suspect.in_tolerances > DistrustedFrom(kind)) cause.leaves = Trust::kNo;
    const auto std_of = [&](int at) { return std::sqrt(solution_.cov(at, at)); };
    const auto axes = [&](const Vector3& value, int at, double scale) {
      return fmt::format("[{:.3g}, {:.3g}, {:.3g}] +- [{:.2g}, {:.2g}, {:.2g}]", scale * value.x(),
                         scale * value.y(), scale * value.z(), scale * std_of(at),
                         scale * std_of(at + 1), scale * std_of(at + 2));
    };
    const RigErrors& errors = solution_.errors;
    if (kind == CauseKind::kClockOffset) {
      const double total_s = rig_.lidar.clock_offset_s + errors.offset_s;
      cause.evidence = fmt::format(
          "turns agree when {:.1f} +- {:.1f} ms are added to the lidar's "
          "stamps",
          1e3 * errors.offset_s, 1e3 * std_of(kRigOffset));
      if (std::abs(errors.offset_s - clock_correction_s_) < kRigFindings.offset_tolerance_s) {
        cause.leaves = Trust::kDoubtful;  // poses before that are late
        cause.evidence += ", as they are since the offset was found on the way";
      }
      cause.fix = fmt::format("rig:\n  lidar:\n    clock_offset_s: {:.4f}\n", total_s);
    } else if (kind == CauseKind::kExtrinsicRotation) {
      cause.evidence = fmt::format(
          "lidar and IMU turn about other axes: rig.T_imu_lidar is off by {:.1f} deg, about x y z "
          "of imu by {} deg",
          AngleDeg(errors.rotation), axes(LogSo3(errors.rotation), kRigRotation, kDegPerRad));
      cause.fix = ExtrinsicYaml(Corrected());
    } else {
      cause.evidence = fmt::format(
          "in turns the lidar moves as one that is elsewhere: rig.T_imu_lidar lacks {} m in imu",
          axes(errors.lever_m, kRigLever, 1.0));
      cause.fix = ExtrinsicYaml(Corrected());
    }
    return cause;
  }

  // Messages in turned axes and a turned extrinsic are the same to all that moves.
  void NameAxes(std::vector<Cause>& causes) const {
    const auto is_quarter_turn = [](const Quaternion& rotation) {
      return std::ranges::any_of(QuarterTurns(), [&](const Matrix3& turn) {
        return turn != Matrix3::Identity() &&
               AngleDeg(rotation.conjugate() * Quaternion(turn)) < kRigFindings.large_rotation_deg;
      });
    };
    if (!is_quarter_turn(R_rig_sent())) return;
    const std::string evidence = fmt::format(
        "the IMU's messages are turned by {:.1f} deg to the axes that rig.T_imu_lidar makes of the "
        "lidar's",
        AngleDeg(R_rig_sent()));
    const double sigmas =
        Sigmas(LogSo3(R_rig_sent()), all_.cov.block<3, 3>(kRigRotation, kRigRotation));
    // Read so, the path is right; which axes the poses are in depends on what the rig means.
    const bool is_read_so = AngleDeg(R_imu_sent_) > 1.0;
    const Trust leaves = is_read_so ? Trust::kDoubtful : Trust::kNo;
    const bool is_named = std::ranges::any_of(
        causes, [](const Cause& cause) { return cause.kind == CauseKind::kExtrinsicRotation; });
    if (!is_named) {
      causes.push_back(
          {CauseKind::kExtrinsicRotation, leaves, sigmas, evidence, ExtrinsicYaml(Corrected())});
    }
    causes.push_back({CauseKind::kImuAxes, leaves, sigmas, evidence, ""});
  }

  const RigSelection& selection_;
  const RigFitResult& all_ = selection_.all();
  const RigFitResult& solution_ = selection_.solution();
  const Rig& rig_;
  Quaternion R_imu_sent_;
  bool is_lever_found_;
  double clock_correction_s_;
};

}  // namespace

RigFindings FindRigErrors(const MotionRecord& record, const Rig& rig,
                          const ImuConvention& convention, bool is_lever_found) {
  RigFit fit(record, rig.imu.accel_bias_std_mps2);
  if (!fit.HasEnough()) return {};
  const RigFit::TurnAlignment turns = fit.AlignTurns();
  if (turns.correlation < kRigFindings.min_correlation) return {};
  if (auto units = JudgeUnits(turns)) {
    RigFindings findings;
    findings.is_checked = true;
    findings.causes.push_back(std::move(*units));
    return findings;
  }
  const RigSelection selection(fit, turns);
  return Naming(selection, rig, convention, is_lever_found, record.clock_correction().Seconds())
      .Name();
}

std::string ExtrinsicYaml(const Pose& T) {
  return fmt::format(
      "rig:\n  T_imu_lidar:\n    translation_m: [{:.3f}, {:.3f}, {:.3f}]\n    rotation_wxyz: "
      "[{:.6f}, {:.6f}, {:.6f}, {:.6f}]\n",
      T.translation.x(), T.translation.y(), T.translation.z(), T.rotation.w(), T.rotation.x(),
      T.rotation.y(), T.rotation.z());
}

}  // namespace lio
