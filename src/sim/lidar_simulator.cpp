// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/lidar_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

constexpr std::size_t kTileColumns =
    8;  // neighbours in azimuth see almost the same, which makes ray packets fast
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLobe_rad = 0.07;       // half width of a polished surface's lobe
constexpr float kMergedEchoes_m = 0.6f;  // two echoes nearer than this merge into one
constexpr float kEdge_m = 0.12f;         // a larger step in range is an edge, not a slope
constexpr double kMaxGrazingBias_m = 0.04;

// Holds two numbers made from one word.
struct Pair {
  double a;
  double b;
};
Pair Halves(std::uint64_t bits) {
  return {(static_cast<double>(bits >> 32) + 0.5) * 0x1.0p-32,
          (static_cast<double>(bits & 0xFFFFFFFFull) + 0.5) * 0x1.0p-32};
}

float GaussianFrom(std::uint64_t bits) {
  const Pair u = Halves(bits);
  return std::sqrt(-2.0f * std::log(static_cast<float>(u.a))) *
         std::cos(static_cast<float>(kTurn * u.b));
}

Vector3 Direction(double elevation_rad, double azimuth_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

// Returns the point at a range along `direction`, which is turned to the column's heading.
LidarPoint PointAt(double range_m, double heading_rad, const Vector3& direction) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  LidarPoint point;
  point.x_m = static_cast<float>(range_m * (c * direction.x() - s * direction.y()));
  point.y_m = static_cast<float>(range_m * (s * direction.x() + c * direction.y()));
  point.z_m = static_cast<float>(range_m * direction.z());
  return point;
}

// Returns the strength of the light that comes back from a surface at 1 m.
double Backscatter(const MaterialTraits& traits, double cos_incidence) {
  double strength = traits.reflectivity * std::sqrt(cos_incidence);
  if (traits.specular > 0.0 && cos_incidence > 0.97) {
    const double off_sq = 2.0 * (1.0 - cos_incidence) / (kLobe_rad * kLobe_rad);
    strength += 2.0 * traits.specular * std::exp(-off_sq);
  }
  return strength;
}

std::uint16_t IntensityOf(double backscatter) {
  // This is Velodyne's scale: matt surfaces have 0..100 in per cent, retroreflectors 101..255.
  const double value =
      backscatter <= 1.0 ? 100.0 * backscatter : 100.0 + 60.0 * (backscatter - 1.0);
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, 255.0));
}

const Dust* DustAt(const std::vector<Dust>& clouds, double t_s) {
  for (const Dust& dust : clouds) {
    if (t_s >= dust.begin_s && t_s < dust.end_s) return &dust;
  }
  return nullptr;
}

}  // namespace

struct LidarSimulator::Columns {
  std::int64_t first = 0;  // counted from sweep 0
  std::int64_t num = 0;
  double begin_s = 0.0;
  double end_s = 0.0;
};

// The arrays are column-major, with one entry per ray.
struct LidarSimulator::Echoes {
  std::vector<Hit> hits;
  std::vector<double> headings_rad;  // one per column
};

LidarSimulator::LidarSimulator(LidarSetup setup, const Scene& scene, const Trajectory& trajectory)
    : setup_(std::move(setup)), scene_(&scene), trajectory_(&trajectory) {
  const LidarModel& model = setup_.model;
  Random random(setup_.seed, Purpose::kLaser);
  for (const Beam& beam : model.beams) {
    const double azimuth = beam.azimuth_offset_rad - kTurn * model.rotation_hz * beam.fire_time_s;
    const double off_elevation = setup_.errors.beam_table_std_rad * random.Gaussian();
    const double off_azimuth = setup_.errors.beam_table_std_rad * random.Gaussian();
    table_directions_.push_back(Direction(beam.elevation_rad, azimuth));
    column_directions_.push_back(
        Direction(beam.elevation_rad + off_elevation, azimuth + off_azimuth));
    laser_bias_m_.push_back(setup_.errors.laser_bias_std_m * random.Gaussian());
  }
  firing_order_.resize(model.beams.size());
  std::iota(firing_order_.begin(), firing_order_.end(), std::size_t{0});
  std::stable_sort(firing_order_.begin(), firing_order_.end(), [&](std::size_t a, std::size_t b) {
    return model.beams[a].fire_time_s < model.beams[b].fire_time_s;
  });
  weakest_echo_ = 0.1 / (model.range_at_10_percent_m * model.range_at_10_percent_m);
}

double LidarSimulator::ColumnTime(std::int64_t column) const {
  return setup_.begin_s + static_cast<double>(column) * setup_.model.column_period_s;
}

double LidarSimulator::HeadingAt(double t_s) const {
  const double turns = (t_s - setup_.begin_s) * setup_.model.rotation_hz;
  return setup_.model.cut_azimuth_rad - kTurn * (turns - std::floor(turns));
}

LidarSimulator::Columns LidarSimulator::ColumnsOf(std::int64_t index) const {
  const double per_turn = 1.0 / (setup_.model.rotation_hz * setup_.model.column_period_s);
  const auto first_of = [&](std::int64_t turn) {  // the margin keeps exact divisors exact
    return static_cast<std::int64_t>(std::ceil(static_cast<double>(turn) * per_turn - 1e-6));
  };
  Columns columns;
  columns.first = first_of(index);
  columns.num = first_of(index + 1) - columns.first;
  columns.begin_s = ColumnTime(columns.first);
  columns.end_s = ColumnTime(columns.first + columns.num);
  return columns;
}

double LidarSimulator::SweepEnd_s(std::int64_t index) const {
  const Columns columns = ColumnsOf(index);
  return ColumnTime(columns.first + columns.num - 1) +
         setup_.model.beams[firing_order_.back()].fire_time_s;
}

void LidarSimulator::CastTile(const Scene::Interval& interval, const Columns& columns,
                              std::int64_t first, Echoes& echoes) const {
  const std::size_t num_beams = setup_.model.beams.size();
  const auto num =
      static_cast<std::size_t>(std::min<std::int64_t>(kTileColumns, columns.num - first));
  std::vector<Ray> rays(num * num_beams);
  for (std::size_t c = 0; c < num; ++c) {
    const std::size_t in_sweep = static_cast<std::size_t>(first) + c;
    const double t_s = ColumnTime(columns.first + static_cast<std::int64_t>(in_sweep));
    const double heading = HeadingAt(t_s);
    echoes.headings_rad[in_sweep] = heading;
    const Kinematics imu = trajectory_->At(t_s);
    const Pose lidar = imu.T_world_imu * setup_.T_imu_lidar;
    const Matrix3 R_world_lidar = lidar.rotation.toRotationMatrix();
    const Vector3 w_world = imu.T_world_imu.rotation * imu.w_imu_radps;
    const Vector3 lever = lidar.translation - imu.T_world_imu.translation;
    const Vector3 v_world = imu.v_world_mps + w_world.cross(lever);
    const Matrix3 R_world_column =
        R_world_lidar * Eigen::AngleAxisd(heading, Vector3::UnitZ()).toRotationMatrix();
    for (std::size_t b = 0; b < num_beams; ++b) {
      // Within a column the motion is taken as linear, which is off by less than 1e-8 m and rad.
      const double dt = setup_.model.beams[b].fire_time_s;
      const Vector3 direction = R_world_column * column_directions_[b];
      Ray& ray = rays[b * num + c];
      ray.origin_m = (lidar.translation + dt * v_world).cast<float>();
      ray.direction = (direction + dt * w_world.cross(direction)).cast<float>();
      ray.time_ratio = static_cast<float>(
          std::min(1.0, (t_s + dt - columns.begin_s) / (columns.end_s - columns.begin_s)));
    }
  }
  std::vector<Hit> hits(rays.size());
  interval.Cast(rays, static_cast<float>(setup_.model.max_range_m), hits);
  for (std::size_t b = 0; b < num_beams; ++b) {
    for (std::size_t c = 0; c < num; ++c) {
      echoes.hits[(static_cast<std::size_t>(first) + c) * num_beams + b] = hits[b * num + c];
    }
  }
}

SimulatedSweep LidarSimulator::Sweep(std::int64_t index) const {
  const Columns columns = ColumnsOf(index);
  const std::size_t num_beams = setup_.model.beams.size();
  const Scene::Interval interval = scene_->During(columns.begin_s, columns.end_s);
  Echoes echoes;
  echoes.hits.resize(static_cast<std::size_t>(columns.num) * num_beams);
  echoes.headings_rad.resize(static_cast<std::size_t>(columns.num));
  for (std::int64_t first = 0; first < columns.num; first += kTileColumns) {
    CastTile(interval, columns, first, echoes);
  }
  SimulatedSweep sweep;
  sweep.begin_ns = static_cast<std::int64_t>(std::llround(columns.begin_s * 1e9));
  sweep.num_rays = static_cast<std::int64_t>(echoes.hits.size());
  sweep.points.reserve(echoes.hits.size());
  sweep.objects.reserve(echoes.hits.size());
  for (std::int64_t column = 0; column < columns.num; ++column) {
    for (const std::size_t beam : firing_order_) AddPoint(columns, echoes, column, beam, sweep);
  }
  return sweep;
}

LidarSimulator::Echo LidarSimulator::Straddle(const Hit& hit, const Neighbour& other,
                                              double edge_at, double chance) const {
  if (!std::isfinite(other.hit->range_m)) return {hit.range_m, false};
  const double depth = other.half_width_rad / other.spacing_rad;
  const float gap = other.hit->range_m - hit.range_m;
  const float slope =
      hit.range_m * static_cast<float>(other.spacing_rad) / std::max(0.1f, hit.cos_incidence);
  if (edge_at > depth || std::abs(gap) < kEdge_m + 2.0f * slope) return {hit.range_m, false};
  const float share = 0.5f * static_cast<float>(1.0 - edge_at / depth);
  if (std::abs(gap) < kMergedEchoes_m || (std::abs(gap) < setup_.errors.in_between_reach_m &&
                                          chance < setup_.errors.in_between_chance)) {
    return {hit.range_m + share * gap, true};
  }
  return {gap < 0.0f && share > 0.3f ? other.hit->range_m : hit.range_m, false};
}

// Only one side of each direction can be straddled; the half width of the beam decides how often.
LidarSimulator::Echo LidarSimulator::Straddle(const Echoes& echoes, std::size_t index,
                                              std::size_t beam, std::uint64_t key) const {
  const LidarModel& model = setup_.model;
  const Hit& hit = echoes.hits[index];
  const std::size_t stride = model.beams.size();
  const Pair across = Halves(MixBits(key + 2));
  const bool next = across.a < 0.5;
  // 0: the edge is here, 1: it is at the other.
  const auto edge_at = [](double uniform) {
    return uniform < 0.5 ? 2.0 * uniform : 2.0 * uniform - 1.0;
  };
  if (next ? index + stride < echoes.hits.size() : index >= stride) {
    const Neighbour column{&echoes.hits[next ? index + stride : index - stride],
                           kTurn * model.rotation_hz * model.column_period_s,
                           0.5 * model.beam_width_horizontal_rad};
    const Echo echo = Straddle(hit, column, edge_at(across.a), across.b);
    if (echo.range_m != hit.range_m) return echo;
  }
  if (!setup_.errors.straddles_rings) return {hit.range_m, false};
  const Pair along = Halves(MixBits(key + 6));
  const bool above = along.a < 0.5;
  if (above ? beam + 1 >= stride : beam == 0) return {hit.range_m, false};
  const std::size_t other = above ? beam + 1 : beam - 1;
  const Neighbour ring{
      &echoes.hits[above ? index + 1 : index - 1],
      std::max(1e-6, std::abs(model.beams[other].elevation_rad - model.beams[beam].elevation_rad)),
      0.5 * model.beam_width_vertical_rad};
  return Straddle(hit, ring, edge_at(along.a), along.b);
}

void LidarSimulator::AddPoint(const Columns& columns, const Echoes& echoes, std::int64_t column,
                              std::size_t beam, SimulatedSweep& sweep) const {
  const LidarModel& model = setup_.model;
  const LidarErrors& errors = setup_.errors;
  const auto in_sweep = static_cast<std::size_t>(column);
  const std::size_t index = in_sweep * model.beams.size() + beam;
  Hit hit = echoes.hits[index];
  const std::uint64_t key = HashKey({setup_.seed, static_cast<std::uint64_t>(Purpose::kLidar),
                                     static_cast<std::uint64_t>(columns.first + column), beam});
  const double t_s = ColumnTime(columns.first + column) + model.beams[beam].fire_time_s;
  const Pair chance = Halves(MixBits(key + 1));
  double range_m = hit.range_m;
  bool is_in_between = false;
  double backscatter = 0.0;
  double std_scale = errors.noise_scale;
  if (hit.object != Hit::kNothing) {
    backscatter = Backscatter(TraitsOf(hit.material), hit.cos_incidence);
    const double weakness = weakest_echo_ * range_m * range_m / backscatter;
    const double weakness_sq = weakness * weakness;
    const bool seen = !errors.has_weak_echoes || chance.a * (1.0 + weakness_sq * weakness_sq) < 1.0;
    if (!seen || chance.b < errors.dropout_ratio) hit.object = Hit::kNothing;
    if (errors.has_mixed_pixels) {
      const Echo echo = Straddle(echoes, index, beam, key);
      range_m = echo.range_m;
      is_in_between = echo.is_in_between;
    }
    const double grazing = 1.0 / std::max(0.05f, hit.cos_incidence) - 1.0;
    range_m += std::min(errors.grazing_bias_m * grazing, kMaxGrazingBias_m) + laser_bias_m_[beam];
    const double slant = std::min(grazing, 6.0);
    std_scale *= std::sqrt(1.0 + 0.15 * slant * slant + 0.5 * std::min(weakness, 2.0));
  }
  if (const Dust* dust = DustAt(errors.dust, t_s)) {
    const double first_m =
        model.min_range_m - std::log(Halves(MixBits(key + 3)).a) / dust->echoes_per_m;
    if (first_m < std::min(range_m, 25.0)) {
      range_m = first_m;
      backscatter = 0.03;
      hit.object = Hit::kFixed;
    }
  }
  if (hit.object == Hit::kNothing) return;
  range_m += std_scale * model.range_std_m * GaussianFrom(MixBits(key + 4));
  if (model.range_step_m > 0.0) {
    range_m = model.range_step_m * std::round(range_m / model.range_step_m);
  }
  if (range_m < model.min_range_m || range_m > model.max_range_m) return;
  LidarPoint point = PointAt(range_m, echoes.headings_rad[in_sweep], table_directions_[beam]);
  point.t_offset_ns = static_cast<std::uint32_t>(
      std::max<std::int64_t>(0, std::llround(t_s * 1e9) - sweep.begin_ns));
  point.intensity = IntensityOf(backscatter * (0.95 + 0.1 * Halves(MixBits(key + 5)).a));
  point.ring = static_cast<std::uint16_t>(beam);
  sweep.num_in_between += is_in_between ? 1 : 0;
  sweep.points.push_back(point);
  sweep.objects.push_back(hit.object);
}

}  // namespace lio::sim
