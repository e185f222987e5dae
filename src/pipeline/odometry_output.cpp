// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT

#include "lio/pipeline/base_motion.hpp"
#include "pipeline/odometry_impl.hpp"

namespace lio {

// Where no gravity is felt nothing levels a world: it is the map's frame.
WorldEstimate Odometry::Impl::InPublishedWorld(const Estimate& estimate) const {
  return g_world_.isZero() ? WithMapAsWorld(estimate) : InWorld(estimate);
}

NavOutput Odometry::Impl::MakeNav(const Estimate& estimate) const {
  NavOutput nav;
  nav.stamp = estimate.stamp;
  nav.scan_seq = last_seq_;
  nav.status = status_;
  const WorldEstimate published = InPublishedWorld(estimate);
  nav.T_world_imu = published.T_world_imu;
  nav.pose_cov = published.cov.topLeftCorner<6, 6>();
  nav.v_world_imu_mps = published.v_world_imu;
  nav.velocity_cov = published.cov.block<3, 3>(kVel, kVel);
  nav.w_imu_radps = -estimate.state.gyro_bias;
  if (history_ && !imu_.empty()) nav.w_imu_radps += SampleAt(imu_, estimate.stamp).w_imu_radps;
  nav.T_map_imu = estimate.state.T_map_imu;
  nav.map_pose_cov = estimate.cov.bottomRightCorner<6, 6>();
  if (options_.rig.T_base_imu) {
    nav.base = MoveToBase(nav, published.cov, RateVariance(nav.stamp), *options_.rig.T_base_imu);
  }
  return nav;
}

// Of the noise in the rate that is published: white noise of a density, over one sample.
double Odometry::Impl::RateVariance(Timestamp stamp) const {
  const auto after = FirstNotBefore(imu_, stamp);
  if (!history_ || after == imu_.begin() || after == imu_.end()) return 0.0;
  const double step_s = SecondsBetween(std::prev(after)->stamp, after->stamp);
  const double density = options_.rig.imu.gyro_noise_density;
  return density * density / step_s;
}

FilterReport Odometry::Impl::MakeFilterReport(const Estimate& estimate,
                                              const ScanReport& report) const {
  FilterReport filter;
  filter.nav = MakeNav(estimate);
  const MapVelocity velocity = VelocityInMap(estimate);
  filter.v_map_imu_mps = velocity.v_map_imu;
  filter.map_velocity_cov = velocity.cov;
  filter.map_as_world_cov = WithMapAsWorld(estimate).cov.topLeftCorner<6, 6>();
  filter.gyro_bias_radps = estimate.state.gyro_bias;
  filter.accel_bias_mps2 = estimate.state.accel_bias;
  filter.g_world_mps2 = g_world_;
  filter.clock_offset_s = options_.rig.lidar.clock_offset_s;
  if (clock_offset_) {
    filter.clock_offset_s += clock_offset_->offset_s();
    filter.clock_offset_std_s = clock_offset_->std_s();
  }
  filter.nis = report.nis;
  filter.nis_dof = report.fused ? 6 : 0;
  filter.cov = estimate.cov;
  filter.cov.topLeftCorner<kAccelBias, kAccelBias>() = InPublishedWorld(estimate).cov;
  return filter;
}

void Odometry::Impl::EmitImuRate() {
  const Estimate& head = history_->head();
  if (is_first_scan_ || (last_published_ && head.stamp <= *last_published_)) return;
  last_published_ = head.stamp;
  NavOutput nav = MakeNav(head);
  nav.source = OdometrySource::kImuPropagated;
  outputs_.emplace_back(nav);
}

}  // namespace lio
