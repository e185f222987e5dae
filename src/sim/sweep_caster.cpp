// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sweep_caster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/relief.hpp"

namespace lio::sim {
namespace {

constexpr std::size_t kTileColumns =
    8;  // neighbours in azimuth see almost the same, which makes ray packets fast
constexpr float kOffPlane_m = 0.04f;     // neighbours nearer to a hit's plane lie on its surface
constexpr float kOffPlaneRatio = 0.02f;  // and this much of their distance more: uneven ground
constexpr float kOffSurface_m = 1e-3f;   // a reflected ray begins this far in front of its mirror

class Caster {
 public:
  Caster(const CastSetup& setup, const TurnColumns& columns)
      : setup_(setup),
        columns_(columns),
        interval_(setup.scene.During(columns.begin_s, columns.end_s,
                                     setup.trajectory.At(columns.begin_s).T_world_imu.translation)),
        num_beams_(setup.directions.size()),
        rays_(static_cast<std::size_t>(columns.num) * num_beams_),
        axes_(static_cast<std::size_t>(columns.num)) {
    sweep_.hits.resize(rays_.size());
    sweep_.R_lidar_column.resize(axes_.size());
  }

  SweepHits Cast() {
    for (std::int64_t first = 0; first < columns_.num; first += kTileColumns) CastTile(first);
    if (setup_.lidar.errors.has_footprint) CastRims();
    if (setup_.lidar.errors.has_glass) CastBehind();
    if (setup_.lidar.errors.has_relief) AddRelief();
    return std::move(sweep_);
  }

 private:
  float max_range_m() const { return static_cast<float>(setup_.lidar.model.max_range_m); }
  void AimColumn(std::size_t column);
  void CastTile(std::int64_t first);
  bool IsOnSurfaceOf(std::size_t ray, std::size_t neighbour) const;
  std::array<bool, kNumSubRays> MayStraddle(std::size_t ray) const;
  Ray SubRay(std::size_t ray, std::size_t side) const;
  void CastRims();
  bool IsBeyondEdge(const Hit& centre, const Ray& ray, const Hit& hit, const Ray& sub_ray) const;
  void CastBehind();
  void AddRelief();

  const CastSetup& setup_;
  const TurnColumns& columns_;
  Scene::Interval interval_;
  std::size_t num_beams_;
  std::vector<Ray> rays_;       // column-major
  std::vector<Vector3f> axes_;  // the rotor's axis in world, one per column
  SweepHits sweep_;
};

void Caster::AimColumn(std::size_t column) {
  const double t_s = setup_.rotor.ColumnTime(columns_.first + static_cast<std::int64_t>(column));
  const Kinematics imu = setup_.trajectory.At(t_s);
  const Pose lidar = imu.T_world_imu * setup_.lidar.T_imu_lidar;
  const Matrix3 R_world_lidar = lidar.rotation.toRotationMatrix();
  const Vector3 w_world = imu.T_world_imu.rotation * imu.w_imu_radps;
  const Vector3 lever = lidar.translation - imu.T_world_imu.translation;
  const Vector3 v_world = imu.v_world_mps + w_world.cross(lever);
  const Matrix3 R_world_column = R_world_lidar * setup_.rotor.OrientationAt(t_s);
  sweep_.R_lidar_column[column] = setup_.rotor.ReportedOrientationAt(t_s);
  axes_[column] = R_world_lidar.col(2).cast<float>();
  for (std::size_t b = 0; b < num_beams_; ++b) {
    // Within a column the motion is taken as linear, which is off by less than 1e-8 m and rad.
    const double dt = setup_.lidar.model.beams[b].fire_time_s;
    const Vector3 direction = R_world_column * setup_.directions[b];
    Ray& ray = rays_[column * num_beams_ + b];
    ray.origin_m = (lidar.translation + dt * v_world).cast<float>();
    ray.direction = (direction + dt * w_world.cross(direction)).cast<float>();
    ray.time_ratio = static_cast<float>(
        std::min(1.0, (t_s + dt - columns_.begin_s) / (columns_.end_s - columns_.begin_s)));
  }
}

// Within a tile, rays go beam by beam, so that a packet holds neighbours in azimuth.
void Caster::CastTile(std::int64_t first) {
  const auto from = static_cast<std::size_t>(first);
  const auto num =
      static_cast<std::size_t>(std::min<std::int64_t>(kTileColumns, columns_.num - first));
  std::vector<Ray> tile(num * num_beams_);
  for (std::size_t c = 0; c < num; ++c) {
    AimColumn(from + c);
    for (std::size_t b = 0; b < num_beams_; ++b) {
      tile[b * num + c] = rays_[(from + c) * num_beams_ + b];
    }
  }
  std::vector<Hit> hits(tile.size());
  interval_.Cast(tile, max_range_m(), hits);
  for (std::size_t b = 0; b < num_beams_; ++b) {
    for (std::size_t c = 0; c < num; ++c) {
      sweep_.hits[(from + c) * num_beams_ + b] = hits[b * num + c];
    }
  }
}

bool Caster::IsOnSurfaceOf(std::size_t ray, std::size_t neighbour) const {
  const Hit& hit = sweep_.hits[ray];
  const Hit& other = sweep_.hits[neighbour];
  if (hit.object != other.object) return false;
  if (hit.object == Hit::kNothing) return true;
  const Ray& from = rays_[ray];
  const Ray& to = rays_[neighbour];
  const Vector3f apart =
      (to.origin_m - from.origin_m) + other.range_m * to.direction - hit.range_m * from.direction;
  return std::abs(hit.normal.dot(apart)) < kOffPlane_m + kOffPlaneRatio * apart.norm();
}

// Towards a neighbour on its own surface a beam is taken to lie on it, too. So things thinner than
// the spacing of beams that no centre meets, as a cable between two rings, stay unseen.
std::array<bool, kNumSubRays> Caster::MayStraddle(std::size_t ray) const {
  const std::size_t beam = ray % num_beams_;
  // The rotor turns clockwise: the column before is to the left.
  return {ray >= num_beams_ && !IsOnSurfaceOf(ray, ray - num_beams_),
          ray + num_beams_ < rays_.size() && !IsOnSurfaceOf(ray, ray + num_beams_),
          beam > 0 && !IsOnSurfaceOf(ray, ray - 1),
          beam + 1 < num_beams_ && !IsOnSurfaceOf(ray, ray + 1)};
}

Ray Caster::SubRay(std::size_t ray, std::size_t side) const {
  const LidarModel& model = setup_.lidar.model;
  const Ray& centre = rays_[ray];
  const Vector3f left = axes_[ray / num_beams_].cross(centre.direction).normalized();
  const Vector3f up = centre.direction.cross(left);
  const auto across = static_cast<float>(0.5 * model.beam_width_horizontal_rad);
  const auto along = static_cast<float>(0.5 * model.beam_width_vertical_rad);
  const std::array<Vector3f, kNumSubRays> off = {across * left, -across * left, -along * up,
                                                 along * up};
  return {centre.origin_m, centre.direction + off[side], centre.time_ratio};
}

bool Caster::IsBeyondEdge(const Hit& centre, const Ray& ray, const Hit& hit,
                          const Ray& sub_ray) const {
  if (centre.object != hit.object) return true;
  if (centre.object == Hit::kNothing) return false;
  // Returns the range at which the sub-ray meets the plane of the centre's surface, if it goes on.
  const float slope = centre.normal.dot(sub_ray.direction);
  const float straight = centre.normal.dot(ray.direction);
  const float continued_m = centre.range_m * straight / slope;
  if (!(continued_m > 0.0f) || !std::isfinite(continued_m)) return true;
  return std::abs(hit.range_m - continued_m) > kRangeEdge_m;
}

void Caster::CastRims() {
  struct Sub {
    std::size_t ray;
    std::size_t side;
  };
  std::vector<Sub> subs;
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const std::array<bool, kNumSubRays> may_straddle = MayStraddle(i);
    for (std::size_t side = 0; side < kNumSubRays; ++side) {
      if (!may_straddle[side]) continue;
      subs.push_back({i, side});
      rays.push_back(SubRay(i, side));
    }
  }
  std::vector<Hit> hits(rays.size());
  interval_.Cast(rays, max_range_m(), hits);
  sweep_.rim_of.assign(rays_.size(), SweepHits::kNone);
  for (std::size_t k = 0; k < subs.size(); ++k) {
    const auto [ray, side] = subs[k];
    if (!IsBeyondEdge(sweep_.hits[ray], rays_[ray], hits[k], rays[k])) continue;
    if (sweep_.rim_of[ray] == SweepHits::kNone) {
      sweep_.rim_of[ray] = static_cast<std::int32_t>(sweep_.rims.size());
      sweep_.rims.emplace_back();
    }
    Rim& rim = sweep_.rims.back();
    rim.hits[side] = hits[k];
    rim.is_beyond_edge[side] = true;
  }
}

void Caster::CastBehind() {
  std::vector<std::size_t> polished;
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const Hit& hit = sweep_.hits[i];
    if (hit.object == Hit::kNothing || !MayShowOthers(hit)) continue;
    polished.push_back(i);
    const Ray& ray = rays_[i];
    const Vector3f point = ray.origin_m + hit.range_m * ray.direction;
    const float along = hit.normal.dot(ray.direction);
    const Vector3f outward = along < 0.0f ? hit.normal : Vector3f(-hit.normal);
    rays.push_back({point + kOffSurface_m * outward, ray.direction - 2.0f * along * hit.normal,
                    ray.time_ratio});
    rays.push_back({point + kPolish.pane_m * ray.direction, ray.direction, ray.time_ratio});
  }
  std::vector<Hit> hits(rays.size());
  interval_.Cast(rays, max_range_m(), hits);
  sweep_.behind_of.assign(rays_.size(), SweepHits::kNone);
  for (std::size_t k = 0; k < polished.size(); ++k) {
    Behind behind{hits[2 * k], Hit()};
    if (sweep_.hits[polished[k]].material == Material::kGlass) behind.through = hits[2 * k + 1];
    sweep_.behind_of[polished[k]] = static_cast<std::int32_t>(k);
    sweep_.behinds.push_back(behind);
  }
}

// The rim of a beam is sought on the smooth mesh, so that no tuft counts as an edge.
void Caster::AddRelief() {
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    Hit& hit = sweep_.hits[i];
    if (hit.object == Hit::kFixed) hit.range_m = RangeOnRelief(rays_[i], hit);
  }
}

}  // namespace

SweepHits CastSweep(const CastSetup& setup, const TurnColumns& columns) {
  return Caster(setup, columns).Cast();
}

}  // namespace lio::sim
