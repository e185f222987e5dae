// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/lidar_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lio/base/angle.hpp"
#include "lio/sim/random.hpp"
#include "sim/polished.hpp"
#include "sweep_caster.hpp"

namespace lio::sim {
namespace {

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
         std::cos(static_cast<float>(kTurn_rad * u.b));
}

Vector3 Direction(double elevation_rad, double azimuth_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

LidarPoint PointAt(double range_m, const Vector3& direction) {
  LidarPoint point;
  point.x_m = static_cast<float>(range_m * direction.x());
  point.y_m = static_cast<float>(range_m * direction.y());
  point.z_m = static_cast<float>(range_m * direction.z());
  return point;
}

bool IsInView(const LidarModel& model, const Vector3& direction) {
  if (model.view_rad >= kTurn_rad) return true;
  const double azimuth_rad = std::atan2(direction.y(), direction.x()) - model.view_azimuth_rad;
  return std::abs(std::remainder(azimuth_rad, kTurn_rad)) <= 0.5 * model.view_rad;
}

const Dust* DustAt(const std::vector<Dust>& clouds, double t_s) {
  for (const Dust& dust : clouds) {
    if (t_s >= dust.begin_s && t_s < dust.end_s) return &dust;
  }
  return nullptr;
}

}  // namespace

struct LidarSimulator::Cast {
  TurnColumns columns;
  SweepHits hits;
};

LidarSimulator::LidarSimulator(LidarSetup setup, const Scene& scene, const Trajectory& trajectory)
    : setup_(std::move(setup)),
      scene_(&scene),
      trajectory_(&trajectory),
      rotor_(setup_.model, setup_.errors.rotor, setup_.seed, setup_.begin_s) {
  const LidarModel& model = setup_.model;
  Random random(setup_.seed, Purpose::kLaser);
  for (const Beam& beam : model.beams) {
    const double azimuth =
        beam.azimuth_offset_rad - kTurn_rad * model.rotation_hz * beam.fire_time_s;
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

double LidarSimulator::SweepEnd_s(std::int64_t index) const {
  const TurnColumns columns = rotor_.ColumnsOf(index);
  return rotor_.ColumnTime(columns.first + columns.num - 1) +
         setup_.model.beams[firing_order_.back()].fire_time_s;
}

SimulatedSweep LidarSimulator::Sweep(std::int64_t index) const {
  Cast cast{rotor_.ColumnsOf(index), {}};
  cast.hits = CastSweep({setup_, column_directions_, rotor_, *scene_, *trajectory_}, cast.columns);
  SimulatedSweep sweep;
  sweep.begin_ns = static_cast<std::int64_t>(std::llround(cast.columns.begin_s * 1e9));
  sweep.num_rays = static_cast<std::int64_t>(cast.hits.hits.size());
  sweep.points.reserve(cast.hits.hits.size());
  sweep.objects.reserve(cast.hits.hits.size());
  sweep.kinds.reserve(cast.hits.hits.size());
  sweep.off_surface_m.reserve(cast.hits.hits.size());
  for (std::int64_t column = 0; column < cast.columns.num; ++column) {
    for (const std::size_t beam : firing_order_) AddPoint(cast, column, beam, sweep);
  }
  return sweep;
}

// Guesses from the next or last column whether the beam straddles an edge; the half width of the
// beam decides how often.
Echo LidarSimulator::GuessStraddling(const Cast& cast, std::size_t index, std::uint64_t key) const {
  const LidarModel& model = setup_.model;
  const std::vector<Hit>& hits = cast.hits.hits;
  const Hit& hit = hits[index];
  const Echo unmixed{hit.range_m, hit, 1.0, EchoKind::kSurface};
  const std::size_t stride = model.beams.size();
  const Pair across = Halves(MixBits(key + 2));
  const bool next = across.a < 0.5;
  if (next ? index + stride >= hits.size() : index < stride) return unmixed;
  const Hit& other = hits[next ? index + stride : index - stride];
  if (!std::isfinite(other.range_m)) return unmixed;
  // 0: the edge is here, 1: it is at the other.
  const double edge_at = across.a < 0.5 ? 2.0 * across.a : 2.0 * across.a - 1.0;
  const double spacing_rad = kTurn_rad * model.rotation_hz * model.column_period_s;
  const double depth = 0.5 * model.beam_width_horizontal_rad / spacing_rad;
  const float gap = other.range_m - hit.range_m;
  const float slope =
      hit.range_m * static_cast<float>(spacing_rad) / std::max(0.1f, hit.cos_incidence);
  if (edge_at > depth || std::abs(gap) < kRangeEdge_m + 2.0f * slope) return unmixed;
  const float share = 0.5f * static_cast<float>(1.0 - edge_at / depth);
  const InBetween& rule = setup_.errors.in_between;
  if (std::abs(gap) < kMergedEchoes_m || (std::abs(gap) < rule.reach_m && across.b < rule.chance)) {
    return {hit.range_m + share * gap, hit, 1.0, EchoKind::kInBetween};
  }
  const bool is_other = gap < 0.0f && share > 0.3f;
  return {is_other ? other.range_m : hit.range_m, hit, 1.0, EchoKind::kSurface};
}

// Returns the echo of a beam by all that its footprint and the light's further ways meet.
Echo LidarSimulator::EchoOf(const Cast& cast, std::size_t index, std::uint64_t key) const {
  const Hit& hit = cast.hits.hits[index];
  Echo echo{hit.range_m, hit, 1.0, EchoKind::kSurface};
  if (const Rim* rim = cast.hits.RimOf(index)) {
    const std::uint64_t draw = HashKey({static_cast<std::uint64_t>(Purpose::kFootprint), key});
    echo = EchoOfFootprint(hit, *rim, setup_.errors.in_between, draw);
  }
  const Behind* behind = cast.hits.BehindOf(index);
  if (behind != nullptr && echo.range_m == double{hit.range_m}) echo = EchoOfPolished(hit, *behind);
  return echo;
}

void LidarSimulator::AddPoint(const Cast& cast, std::int64_t column, std::size_t beam,
                              SimulatedSweep& sweep) const {
  const LidarModel& model = setup_.model;
  const LidarErrors& errors = setup_.errors;
  const std::size_t index = static_cast<std::size_t>(column) * model.beams.size() + beam;
  const std::int64_t in_log = cast.columns.first + column;
  const std::uint64_t key = HashKey({setup_.seed, static_cast<std::uint64_t>(Purpose::kLidar),
                                     static_cast<std::uint64_t>(in_log), beam});
  const double t_s = rotor_.ColumnTime(in_log) + model.beams[beam].fire_time_s;
  Echo echo = EchoOf(cast, index, key);
  bool is_seen = echo.surface.object != Hit::kNothing;
  double backscatter = 0.0;
  double std_scale = errors.noise_scale;
  if (is_seen) {
    backscatter = BackscatterOf(echo);
    const Pair chance = Halves(MixBits(key + 1));
    const double weakness = weakest_echo_ * echo.range_m * echo.range_m / backscatter;
    const double weakness_sq = weakness * weakness;
    is_seen = !errors.has_weak_echoes || chance.a * (1.0 + weakness_sq * weakness_sq) < 1.0;
    if (chance.b < errors.dropout_ratio) is_seen = false;
    if (errors.has_mixed_pixels && !errors.has_footprint && echo.kind == EchoKind::kSurface) {
      echo = GuessStraddling(cast, index, key);
    }
    const double grazing = 1.0 / std::max(0.05f, echo.surface.cos_incidence) - 1.0;
    echo.range_m +=
        std::min(errors.grazing_bias_m * grazing, kMaxGrazingBias_m) + laser_bias_m_[beam];
    echo.range_m += RangeWalkOf(errors.range_walk, backscatter);
    const double slant = std::min(grazing, 6.0);
    std_scale *= std::sqrt(1.0 + 0.15 * slant * slant + 0.5 * std::min(weakness, 2.0));
  }
  if (const Dust* dust = DustAt(errors.dust, t_s)) {
    const double first_m =
        model.min_range_m - std::log(Halves(MixBits(key + 3)).a) / dust->echoes_per_m;
    if (first_m < std::min(echo.range_m, 25.0)) {
      echo.range_m = first_m;
      backscatter = 0.03;
      echo.surface.object = Hit::kFixed;
      echo.kind = EchoKind::kDust;
      is_seen = true;
    }
  }
  if (!is_seen) return;
  const Vector3 direction =
      cast.hits.R_lidar_column[static_cast<std::size_t>(column)] * table_directions_[beam];
  if (!IsInView(model, direction)) return;
  double range_m = echo.range_m + std_scale * model.range_std_m * GaussianFrom(MixBits(key + 4));
  if (model.range_step_m > 0.0) {
    range_m = model.range_step_m * std::round(range_m / model.range_step_m);
  }
  if (range_m < model.min_range_m || range_m > model.max_range_m) return;
  LidarPoint point = PointAt(range_m, direction);
  point.t_offset_ns = static_cast<std::uint32_t>(
      std::max<std::int64_t>(0, std::llround(t_s * 1e9) - sweep.begin_ns));
  point.intensity = IntensityOf(backscatter * (0.95 + 0.1 * Halves(MixBits(key + 5)).a));
  point.ring = static_cast<std::uint16_t>(beam);
  sweep.points.push_back(point);
  sweep.objects.push_back(echo.surface.object);
  sweep.kinds.push_back(echo.kind);
  sweep.off_surface_m.push_back(static_cast<float>(echo.off_surface_m));
}

}  // namespace lio::sim
