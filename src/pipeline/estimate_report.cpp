// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/estimate_report.hpp"

#include <iterator>

#include "lio/filter/published_estimate.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "pipeline/base_motion.hpp"
#include "pipeline/extrinsic_doubt.hpp"
#include "pipeline/imu_noise_watch.hpp"

namespace lio {
namespace {

// The world is the map's frame if no gravity is felt, as nothing levels it then.
WorldEstimate InPublishedWorld(const Estimate& estimate, const Vector3& g_world) {
  return g_world.isZero() ? WithMapAsWorld(estimate) : InWorld(estimate);
}

WorldEstimate WithDoubt(WorldEstimate estimate, Timestamp stamp, const ReportContext& context) {
  if (context.gate_doubt) AddGateDoubt(*context.gate_doubt, stamp, estimate);
  context.yaw_doubt.AddTo(estimate);
  if (const auto& std = context.extrinsic.std()) AddExtrinsicDoubt(*std, estimate);
  return estimate;
}

WorldEstimate Published(const Estimate& estimate, const ReportContext& context) {
  return WithDoubt(InPublishedWorld(estimate, context.g_world), estimate.stamp, context);
}

// Returns the variance of the noise in the published rate: white noise as the gyro shows it, and no
// less than the rig's, over the time of one sample [(rad/s)^2].
double RateVariance(Timestamp stamp, const ReportContext& context) {
  if (context.imu == nullptr) return 0.0;
  const std::deque<ImuSample>& samples = context.imu->samples();
  const auto after = FirstNotBefore(samples, stamp);
  if (after == samples.begin() || after == samples.end()) return 0.0;
  const double step_s = SecondsBetween(std::prev(after)->stamp, after->stamp);
  const double density =
      RaisedTo(context.imu->NoiseAt(stamp), context.options.rig.imu).gyro_noise_density;
  return density * density / step_s;
}

}  // namespace

NavOutput MakeNav(const Estimate& estimate, const ReportContext& context) {
  NavOutput nav;
  nav.stamp = estimate.stamp;
  nav.scan_seq = context.last_seq;
  nav.status = context.status;
  const WorldEstimate published = Published(estimate, context);
  nav.T_world_imu = published.T_world_imu;
  nav.pose_cov = published.cov.topLeftCorner<6, 6>();
  nav.v_world_imu_mps = published.v_world_imu;
  nav.velocity_cov = published.cov.block<3, 3>(kVel, kVel);
  nav.w_imu_radps = -estimate.state.gyro_bias;
  if (context.imu != nullptr && !context.imu->samples().empty()) {
    nav.w_imu_radps += SampleAt(context.imu->samples(), estimate.stamp).w_imu_radps;
  }
  nav.T_map_imu = estimate.state.T_map_imu;
  nav.map_pose_cov = estimate.cov.block<6, 6>(kMapPose, kMapPose);
  if (const auto& std = context.extrinsic.std()) {
    nav.map_pose_cov += ExtrinsicDoubtInMap(*std, nav.T_map_imu);
  }
  if (context.gate_doubt) nav.map_pose_cov += GateDoubtInMap(*context.gate_doubt, nav.stamp);
  if (const auto& T_base_imu = context.options.rig.T_base_imu) {
    nav.base = MoveToBase(nav, published.cov, RateVariance(nav.stamp, context), *T_base_imu);
  }
  return nav;
}

FilterReport MakeFilterReport(const Estimate& estimate, const ScanReport& report,
                              const ReportContext& context) {
  FilterReport filter;
  filter.nav = MakeNav(estimate, context);
  filter.is_inertial = context.imu != nullptr;
  const MapVelocity velocity = VelocityInMap(estimate);
  filter.v_map_imu_mps = velocity.v_map_imu;
  filter.map_velocity_cov = velocity.cov;
  filter.map_as_world_cov =
      WithDoubt(WithMapAsWorld(estimate), estimate.stamp, context).cov.topLeftCorner<6, 6>();
  filter.gyro_bias_radps = estimate.state.gyro_bias;
  filter.accel_bias_mps2 = estimate.state.accel_bias;
  filter.g_world_mps2 = context.g_world;
  filter.clock_offset_s = context.clocks.total_s();
  filter.clock_offset_std_s = context.clocks.std_s();
  filter.found_clock = context.clocks.Found();
  filter.T_imu_lidar = context.extrinsic.T_imu_lidar();
  filter.nis = report.nis;
  filter.nis_dof = report.fused ? 6 : 0;
  filter.cov = estimate.cov.topLeftCorner<kMapStart, kMapStart>();
  filter.cov.topLeftCorner<kAccelBias, kAccelBias>() = Published(estimate, context).cov;
  filter.cov.block<6, 6>(kMapPose, kMapPose) = filter.nav.map_pose_cov;
  return filter;
}

PoseRow MakePoseRow(const FilterReport& filter) {
  const NavOutput& nav = filter.nav;
  PoseRow row;
  row.stamp = nav.stamp;
  row.is_located = nav.status == TrackingStatus::kOk || nav.status == TrackingStatus::kDegenerate;
  row.T_map_imu = nav.T_map_imu;
  row.position_cov = filter.map_as_world_cov.topLeftCorner<3, 3>();
  row.rotation_cov = nav.pose_cov.bottomRightCorner<3, 3>();
  row.R_world_imu = nav.T_world_imu.rotation;
  row.imu_noise = filter.imu_noise;
  row.is_guessed = !filter.is_inertial && nav.status == TrackingStatus::kDegenerate;
  return row;
}

LastFix MakeFix(Timestamp stamp, const Estimate& estimate, const Vector3& g_world) {
  const WorldEstimate published = InPublishedWorld(estimate, g_world);
  return {stamp, published.T_world_imu, published.v_world_imu, estimate.state.T_map_imu,
          published.cov.topLeftCorner<6, 6>()};
}

}  // namespace lio
