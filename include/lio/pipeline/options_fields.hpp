// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names every option once: key, field, meaning with unit, and limits as data. Loading, printing,
// range checks and config/default.yaml all come from here, so a new option is one line here and one
// in its struct (a test counts the fields of both).
//
//   VisitFields(visitor, options) calls visitor(key, field, meaning) or
//   visitor(key, field, meaning, range) for each field in order. A field may be a struct of fields
//   itself (kIsGroup), or an optional one.
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

#include "lio/pipeline/options.hpp"

namespace lio {

// Both ends belong to the range. Vectors: every entry.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// Names as configuration writes them, indexed by the enumerator's value.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kEnumNames{};
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<MatchMethod>{"ndt", "loam", "gicp"};
template <>
inline constexpr std::array<std::string_view, 5> kEnumNames<ImuUnits>{"auto", "si", "g", "deg",
                                                                      "g_deg"};
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<GravityInput>{"auto", "present",
                                                                          "removed"};

template <>
inline constexpr std::array<std::string_view, 2> kEnumNames<LoamTarget>{"map", "scan"};

template <class Enum>
[[nodiscard]] constexpr std::string_view EnumName(Enum value) {
  return kEnumNames<Enum>[static_cast<std::size_t>(value)];
}

// Accepts structs whose fields VisitFields lists.
template <class T, class... Ts>
inline constexpr bool kIsOneOf = (std::same_as<T, Ts> || ...);
template <class T>
inline constexpr bool kIsGroup =
    kIsOneOf<T, Options, Rig, LidarRig, LidarBeams, ImuRig, OwnVehicleBox, Pose, Extrinsic,
             PipelineOptions, StartOptions, ReduceOptions, NdtOptions, LoamFeatureOptions,
             LoamOptions, GicpOptions, FilterOptions>;

template <class T, class Struct>
concept MaybeConst = std::same_as<std::remove_const_t<T>, Struct>;

// Sensors with a larger noise density are a unit mistake. Chosen: 1000 times a consumer unit and
// more.
inline constexpr double kMaxDensity = 10.0;
// Norms nearer to 1 are rounding, and normalised. Chosen: four printed digits.
inline constexpr double kMaxQuaternionNormError = 1e-3;

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<Pose> auto& o) {
  visit("translation_m", o.translation, "origin of the second frame in the first, x y z [m]",
        Range{-100, 100});
  visit("rotation_wxyz", o.rotation, "unit quaternion, w first");
}

// A pose's keys go together in a configuration; these two have defaults.
inline constexpr std::string_view kExtrinsicStdKeys[] = {"std_m", "std_deg"};

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<Extrinsic> auto& o) {
  using PartOfPose =
      std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(o)>>, const Pose, Pose>;
  VisitFields(visit, static_cast<PartOfPose&>(o));
  visit("std_m", o.std_m, "how well the translation is known, 1 sigma of an axis [m]; 0: exactly",
        Range{0, 100});
  visit("std_deg", o.std_deg, "how well the rotation is known, 1 sigma of an axis; 0: exactly",
        Range{0, 180});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<OwnVehicleBox> auto& o) {
  visit("min_m", o.min_m, "corner with the smallest x y z, lidar frame [m]", Range{-100, 100});
  visit("max_m", o.max_m, "corner with the largest x y z, lidar frame [m]", Range{-100, 100});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<LidarBeams> auto& o) {
  const Range error{-1, 1};
  const Range error_std{1e-6, 1};
  visit("range_m", o.range_m, "measured minus true, by ring, lowest first [m]", error);
  visit("range_std_m", o.range_std_m, "how well it is known, 1 sigma [m]", error_std);
  visit("elevation_rad", o.elevation_rad, "measured minus true, by ring [rad]", error);
  visit("elevation_std_rad", o.elevation_std_rad, "1 sigma [rad]", error_std);
  visit("azimuth_rad", o.azimuth_rad, "measured minus true, by ring, counter-clockwise [rad]",
        error);
  visit("azimuth_std_rad", o.azimuth_std_rad, "1 sigma [rad]", error_std);
  visit("encoder_rad", o.encoder_rad, "in all azimuths, times cosine and sine of the azimuth [rad]",
        error);
  visit("encoder_std_rad", o.encoder_std_rad, "1 sigma [rad]", error_std);
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<LidarRig> auto& o) {
  visit("model", o.model, "beam table in config/lidars: hdl32e, vlp16, hdl64e, os1_64; or generic");
  visit("min_range_m", o.min_range_m, "nearer returns are dropped [m]", Range{0, 100});
  visit("max_range_m", o.max_range_m, "farther returns are dropped [m]", Range{1, 1000});
  visit("clock_offset_s", o.clock_offset_s,
        "added to the lidar's stamps to have the IMU's clock; lio-log calibrate finds it [s]",
        Range{-10, 10});
  visit("own_vehicle_box", o.own_vehicle_box, "returns inside are the vehicle itself; optional");
  visit("beams", o.beams,
        "errors of the beams from beams.yaml of an earlier run; optional, since they are found on "
        "the way");
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<ImuRig> auto& o) {
  const Range density{1e-9, kMaxDensity};
  visit("gyro_noise_density", o.gyro_noise_density, "white noise [rad/s/sqrt(Hz)]", density);
  visit("accel_noise_density", o.accel_noise_density, "white noise [m/s^2/sqrt(Hz)]", density);
  visit("gyro_bias_walk_density", o.gyro_bias_walk_density, "bias walk [rad/s^2/sqrt(Hz)]",
        Range{0, kMaxDensity});
  visit("accel_bias_walk_density", o.accel_bias_walk_density, "bias walk [m/s^3/sqrt(Hz)]",
        Range{0, kMaxDensity});
  visit("gyro_bias_std_radps", o.gyro_bias_std_radps, "turn-on bias, 1 sigma [rad/s]", Range{0, 1});
  visit("accel_bias_std_mps2", o.accel_bias_std_mps2, "turn-on bias, 1 sigma [m/s^2]",
        Range{0, 10});
  visit("units", o.units,
        "units of its messages: m/s^2 or g, rad/s or deg/s; auto also finds turned axes");
  visit("gravity", o.gravity, "is gravity part of the accelerometer's reading; auto finds out");
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<Rig> auto& o) {
  visit("T_imu_lidar", o.T_imu_lidar,
        "p_imu = T_imu_lidar * p_lidar; required when pipeline.use_imu");
  visit("T_base_imu", o.T_base_imu,
        "p_base = T_base_imu * p_imu; optional: gives LIO_ODOM_BASE as well");
  visit("lidar", o.lidar, "the lidar");
  visit("imu", o.imu, "the IMU: continuous-time densities, one number for the three axes");
  visit("gravity_mps2", o.gravity_mps2, "local gravity [m/s^2]", Range{1, 20});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<PipelineOptions> auto& o) {
  visit("use_imu", o.use_imu, "false: lidar-only odometry by a constant-velocity guess");
  visit("method", o.method, "registration of scans against the map");
  visit("num_threads", o.num_threads,
        "method ndt: threads that matching may use; results do not depend on it", Range{1, 64});
  visit("incomplete_sweep_wait_s", o.incomplete_sweep_wait_s,
        "an incomplete sweep is closed when the IMU is this far past its end [s]", Range{0, 1});
  visit("map_locked", o.map_locked, "with --initial-map: scans leave that map as it is");
  visit("max_queued_scans", o.max_queued_scans,
        "live: with more waiting scans the oldest is dropped; live and replayed alike, a clock "
        "offset that is found moves the scans that come so many + 3 later",
        Range{1, 1000});
  visit("publish_features", o.publish_features,
        "live, method loam: LIO_CORNER_SHARP and the other sets of each scan");
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<StartOptions> auto& o) {
  visit("rest_s", o.rest_s, "a static start uses this much rest [s]", Range{0.1, 1.5});
  visit("max_gyro_std_radps", o.max_gyro_std_radps, "more spread than this is motion [rad/s]",
        Range{1e-6, 1});
  visit("max_accel_std_mps2", o.max_accel_std_mps2, "more spread than this is motion [m/s^2]",
        Range{1e-6, 10});
  visit("moving_window_s", o.moving_window_s, "a start in motion aligns this much of it [s]",
        Range{1.5, 3.0});
  visit("wait_for_rest_s", o.wait_for_rest_s, "in motion, rest is awaited this long first [s]",
        Range{0, 3600});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<ReduceOptions> auto& o) {
  visit("voxel_m", o.voxel_m, "edge of the thinning grid for the first scan [m]", Range{0.01, 10});
  visit("min_voxel_m", o.min_voxel_m, "the edge then adapts, from this [m]", Range{0.01, 10});
  visit("max_voxel_m", o.max_voxel_m, "to this [m]", Range{0.01, 10});
  visit("target_points", o.target_points, "to leave about this many points, for the map",
        Range{400, 1000000});
  visit("match_points", o.match_points, "about this many of them are matched; more is slower",
        Range{400, 1000000});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<NdtOptions> auto& o) {
  visit("voxel_m", o.voxel_m, "edge of the largest map cells; larger catches from farther [m]",
        Range{0.05, 20});
  visit("num_levels", o.num_levels, "resolutions of the map, each half as large as the next",
        Range{1, kMaxMapLevels});
  visit("min_cell_points", o.min_cell_points, "a cell with fewer points does not count",
        Range{3, 1000});
  visit("max_cell_points", o.max_cell_points, "a cell with as many points is frozen",
        Range{3, 1000000});
  visit("max_iterations", o.max_iterations, "most iterations of one match", Range{1, 1000});
  visit("converged_step_m", o.converged_step_m, "a smaller step ends the match, if also [m]",
        Range{0, 1});
  visit("converged_step_rad", o.converged_step_rad, "the rotation step is smaller [rad]",
        Range{0, 1});
  visit("min_surface_std_m", o.min_surface_std_m,
        "floor of a cell's thickness; not below the range noise [m]", Range{1e-4, 1});
  visit("max_cells", o.max_cells, "memory bound of the map; the least recently seen go first",
        Range{1000, 100000000});
  visit("max_distance_m", o.max_distance_m, "cells farther from the vehicle are dropped [m]",
        Range{10, 100000});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<LoamFeatureOptions> auto& o) {
  visit("num_sectors", o.num_sectors, "sectors of a ring, each picked from alone", Range{1, 100});
  visit("num_sharp", o.num_sharp, "sharpest edge points of a sector", Range{0, 1000});
  visit("num_less_sharp", o.num_less_sharp, "edge points of a sector, sharp ones included",
        Range{0, 1000});
  visit("num_flat", o.num_flat, "flattest surface points of a sector", Range{0, 1000});
  visit("curvature_m2", o.curvature_m2,
        "squared sum of ten neighbours' offsets: edges above, flats below [m^2]", Range{1e-6, 100});
  visit("leaf_m", o.leaf_m, "other surface points are thinned to one a voxel and ring [m]",
        Range{0.01, 10});
  visit("break_m2", o.break_m2, "a larger squared gap ends a feature [m^2]", Range{1e-6, 100});
  visit("min_occlusion_m", o.min_occlusion_m,
        "a range jump from which the far side may lie in a shadow [m]", Range{0.01, 100});
  visit("max_occlusion_gap_deg", o.max_occlusion_gap_deg,
        "beams farther apart do not shadow each other [deg]", Range{0, 90});
  visit("min_incidence_deg", o.min_incidence_deg,
        "surfaces that beams graze at less are left out [deg]", Range{0, 90});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<LoamOptions> auto& o) {
  visit("target", o.target, "target of the matches: the map, or the scan before");
  visit("edge_leaf_m", o.edge_leaf_m, "voxel of the edge map, one point each [m]", Range{0.05, 10});
  visit("surface_leaf_m", o.surface_leaf_m, "voxel of the surface map [m]; A-LOAM 0.8",
        Range{0.05, 10});
  visit("max_leaf_points", o.max_leaf_points, "a voxel with as many points is frozen",
        Range{1, 1000000});
  visit("num_neighbours", o.num_neighbours, "points that a line or a plane is laid through",
        Range{3, 8});
  visit("min_line_ratio", o.min_line_ratio,
        "least ratio of a line's spread along it to the next largest", Range{1, 1000});
  visit("max_plane_error_m", o.max_plane_error_m, "a plane fits none of its points worse [m]",
        Range{0.001, 10});
  visit("huber_m", o.huber_m, "residuals above count linearly [m]", Range{0.001, 10});
  visit("edge_std_m", o.edge_std_m, "how well an edge point tells where the edge is [m]",
        Range{1e-4, 10});
  visit("surface_std_m", o.surface_std_m, "the same of a surface point [m]", Range{1e-4, 10});
  visit("max_iterations", o.max_iterations, "most iterations in one round", Range{1, 1000});
  visit("max_rounds", o.max_rounds, "correspondences are sought anew in each; A-LOAM always 2",
        Range{1, 1000});
  visit("converged_step_m", o.converged_step_m, "a smaller step ends the match, if also [m]",
        Range{0, 1});
  visit("converged_step_rad", o.converged_step_rad, "the rotation step is smaller [rad]",
        Range{0, 1});
  visit("max_leaves", o.max_leaves, "memory bound of each map; the least recently seen go first",
        Range{1000, 100000000});
  visit("max_distance_m", o.max_distance_m, "leaves farther from the vehicle are dropped [m]",
        Range{10, 100000});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<GicpOptions> auto& o) {
  visit("surface_std_m", o.surface_std_m,
        "floor of a surface's thickness; not below the range noise [m]", Range{1e-4, 1});
  visit("shape_voxel_m", o.shape_voxel_m, "a point's shape comes from three such voxels around [m]",
        Range{0.05, 10});
  visit("shape_voxel_rad", o.shape_voxel_rad, "or this much of its range: two beams at least [rad]",
        Range{1e-3, 1});
  visit("keyframe_openness_ratio", o.keyframe_openness_ratio,
        "a keyframe every so much of the place's median range", Range{0, 10});
  visit("min_keyframe_m", o.min_keyframe_m, "but at least so far apart [m]", Range{0, 1000});
  visit("max_keyframe_m", o.max_keyframe_m, "and at most [m]", Range{0, 1000});
  visit("keyframe_deg", o.keyframe_deg, "or after turning this much [deg]", Range{0, 360});
  visit("num_near_keyframes", o.num_near_keyframes, "nearest keyframes in the submap",
        Range{1, 10000});
  visit("num_hull_keyframes", o.num_hull_keyframes,
        "nearest keyframes on the convex hull of all, also in the submap", Range{0, 10000});
  visit("max_iterations", o.max_iterations, "most iterations of one match", Range{1, 1000});
  visit("converged_step_m", o.converged_step_m, "a smaller step ends the match, if also [m]",
        Range{0, 1});
  visit("converged_step_rad", o.converged_step_rad, "the rotation step is smaller [rad]",
        Range{0, 1});
  visit("max_points", o.max_points,
        "memory bound of the map; the longest unused keyframes go first", Range{1000, 100000000});
  visit("max_distance_m", o.max_distance_m, "keyframes farther from the vehicle are dropped [m]",
        Range{10, 100000});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<FilterOptions> auto& o) {
  visit("history_s", o.history_s, "how late a measurement may come [s]", Range{0.1, 60});
  visit("gate_probability", o.gate_probability,
        "a pose farther off than this quantile is not fused", Range{0.5, 0.999999999});
  visit("max_gated_in_a_row", o.max_gated_in_a_row,
        "then it is fused all the same, as a motion that was not seen", Range{1, 1000});
  visit("use_zero_velocity", o.use_zero_velocity,
        "a vehicle that stands still, to IMU and lidar together, has no velocity");
  visit("estimate_clock_offset", o.estimate_clock_offset,
        "follow what is left of the offset between the clocks of lidar and IMU, up to 120 ms");
  visit("estimate_extrinsic", o.estimate_extrinsic,
        "correct rig.T_imu_lidar where the motion shows that it is surely wrong");
  visit("registration_cov_scale", o.registration_cov_scale,
        "factor on the match covariance; above 1 trusts matches less", Range{1e-3, 1e6});
  visit("map_walk_scale", o.map_walk_scale,
        "how far a map grown from scans drifts; larger widens the covariance", Range{0, 100});
}

template <class Visitor>
void VisitFields(Visitor& visit, MaybeConst<Options> auto& o) {
  visit("rig", o.rig, "sensors as they are mounted on the vehicle");
  visit("pipeline", o.pipeline, "method, threads and queues");
  visit("start", o.start, "how the filter finds its first state, at rest or in motion");
  visit("reduce", o.reduce, "how a sweep is thinned before it is deskewed and matched");
  visit("ndt", o.ndt, "the normal-distributions map and its matcher");
  visit("loam_features", o.loam_features, "choice of edge and surface points (method loam)");
  visit("loam", o.loam, "LOAM's maps and matcher");
  visit("gicp", o.gicp, "direct matching against keyframes");
  visit("filter", o.filter, "the error-state filter");
}

}  // namespace lio
