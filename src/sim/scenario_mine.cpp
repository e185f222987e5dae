// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the mine: a gallery of rough rock, 3.4 m wide and 2.9 m high, that bends, rises and falls,
// with blind drifts on both sides and dust in the air.
#include <algorithm>
#include <cmath>
#include <vector>

#include "carrier.hpp"
#include "isosurface.hpp"
#include "lio/base/angle.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfGallery_m = 1.7;
constexpr double kGalleryHeight_m = 2.9;
constexpr double kRounding_m = 0.9;  // radius of the corners between walls, roof and floor
constexpr double kCell_m = 0.22;

// Holds a piece of a gallery's middle line, on the floor.
struct Piece {
  Vector3 from_m;
  Vector3 to_m;
};

// Gives the rock's roughness: waves of 0.5 to 5 m, the longer the higher.
class Roughness {
 public:
  explicit Roughness(Random& random) {
    constexpr int kWaves = 14;
    for (int i = 0; i < kWaves; ++i) {
      const double length_m = 0.5 * std::pow(10.0, static_cast<double>(i) / (kWaves - 1));
      const double z = random.Gaussian();
      const double y = random.Gaussian();
      const Vector3 direction = Vector3(random.Gaussian(), y, z).normalized();
      waves_.push_back({kTurn_rad / length_m * direction, 0.035 * std::pow(length_m, 0.7),
                        random.Uniform(0.0, kTurn_rad)});
    }
  }
  double At(const Vector3& p_m) const {
    double sum_m = 0.0;
    for (const Wave& wave : waves_) {
      sum_m += wave.amplitude_m * std::sin(wave.wave_vector_per_m.dot(p_m) + wave.phase_rad);
    }
    return sum_m;
  }

 private:
  struct Wave {
    Vector3 wave_vector_per_m;
    double amplitude_m = 0.0;
    double phase_rad = 0.0;
  };
  std::vector<Wave> waves_;
};

// Gives the open room of all galleries.
class Galleries {
 public:
  explicit Galleries(Random& random) : roughness_(random) {}

  void Add(const Vector3& from_m, const Vector3& to_m) { pieces_.push_back({from_m, to_m}); }

  double Distance(const Vector3& p_m) const {
    double nearest_m = 1e9;
    double above_floor_m = 0.0;
    for (const Piece& piece : pieces_) {
      const Vector3 along = piece.to_m - piece.from_m;
      const double share = std::clamp(
          (p_m - piece.from_m).head<2>().dot(along.head<2>()) / along.head<2>().squaredNorm(), 0.0,
          1.0);
      const Vector3 off = p_m - piece.from_m - share * along;
      const double distance_m = Section(off.head<2>().norm(), off.z());
      if (distance_m < nearest_m) {
        nearest_m = distance_m;
        above_floor_m = off.z();
      }
    }
    // The floor is trodden and driven flat.
    const double rough = 0.3 + 0.7 * std::clamp(above_floor_m / 0.6, 0.0, 1.0);
    return nearest_m + rough * roughness_.At(p_m);
  }

  // Finds the floor between half a metre below and above a height.
  double FloorAt(const Vector3& p_m) const {
    double low_m = p_m.z() - 0.5;
    double high_m = p_m.z() + 0.5;
    for (int i = 0; i < 16; ++i) {
      const double middle_m = 0.5 * (low_m + high_m);
      const bool is_open = Distance({p_m.x(), p_m.y(), middle_m}) < 0.0;
      (is_open ? high_m : low_m) = middle_m;
    }
    return high_m;
  }

 private:
  // Returns the distance from a rounded rectangle that stands on z = 0.
  static double Section(double beside_m, double z_m) {
    const double x = beside_m - kHalfGallery_m + kRounding_m;
    const double z = std::abs(z_m - 0.5 * kGalleryHeight_m) - 0.5 * kGalleryHeight_m + kRounding_m;
    const double outside_m = std::hypot(std::max(x, 0.0), std::max(z, 0.0));
    return outside_m + std::min(std::max(x, z), 0.0) - kRounding_m;
  }

  Roughness roughness_;
  std::vector<Piece> pieces_;
};

// Returns a way that bends by up to 40 degrees every 12 to 24 m but keeps its general direction.
Path Way(double length_m, Random& random) {
  std::vector<Vector2> points = {Vector2::Zero()};
  for (double along_m = 0.0; along_m < length_m;) {
    const double leg_m = random.Uniform(12.0, 24.0);
    const double heading = random.Uniform(-0.7, 0.7);
    points.emplace_back(points.back() + leg_m * Vector2(std::cos(heading), std::sin(heading)));
    along_m += leg_m;
  }
  return Path::Rounded(points, 4.0, false);
}

double LevelAt(double along_m) {
  return 1.1 * std::sin(kTurn_rad * along_m / 75.0);
}

void AddGallery(Galleries& galleries, const Path& way) {
  constexpr double kPiece_m = 1.5;
  const auto at = [&](double along_m) {
    const Vector2 p = way.At(along_m).position_m;
    return Vector3(p.x(), p.y(), LevelAt(along_m));
  };
  for (double along_m = -6.0; along_m < way.length_m() + 6.0; along_m += kPiece_m) {
    galleries.Add(at(along_m), at(along_m + kPiece_m));
  }
}

void AddDrifts(Galleries& galleries, const Path& way, Random& random) {
  double side = random.Chance(0.5) ? 1.0 : -1.0;
  for (double along_m = 8.0; along_m < way.length_m(); along_m += random.Uniform(11.0, 24.0)) {
    const PathPoint from = way.At(along_m);
    const double heading = from.heading_rad + side * random.Uniform(1.1, 1.7);
    const double length_m = random.Uniform(4.0, 13.0);
    const Vector2 reach = length_m * Vector2(std::cos(heading), std::sin(heading));
    const double z = LevelAt(along_m);
    galleries.Add({from.position_m.x(), from.position_m.y(), z},
                  {from.position_m.x() + reach.x(), from.position_m.y() + reach.y(),
                   z + 0.06 * length_m * random.Uniform(-1.0, 1.0)});
    side = -side;
  }
}

}  // namespace

Scenario MakeMine(const ScenarioOptions& options) {
  const Carrier carrier = options.carrier.value_or(Carrier::kRobot);
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(90.0);
  Random random(options.seed, Purpose::kWorld, 13);
  const Path way =
      Way(LimitsOf(carrier).speed_mps * PlannedSeconds(scenario, options) + 5.0, random);
  Galleries galleries(random);
  AddGallery(galleries, way);
  AddDrifts(galleries, way, random);

  constexpr double kAround_m = 16.0;
  Vector3 low = Vector3::Constant(1e9);
  Vector3 high = Vector3::Constant(-1e9);
  for (const Vector2& p : way.Sampled(2.0)) {
    low.head<2>() = low.head<2>().cwiseMin(p);
    high.head<2>() = high.head<2>().cwiseMax(p);
  }
  low -= Vector3(kAround_m, kAround_m, 0.0);
  high += Vector3(kAround_m, kAround_m, 0.0);
  low.z() = -3.5;
  high.z() = 6.5;
  AddIsosurface(
      scenario.world.fixed.page(), [&](const Vector3& p_m) { return galleries.Distance(p_m); }, low,
      high, kCell_m, Material::kEarth);
  const auto floor = [&](const Vector2& p_m, double along_m) {
    const double level_m = LevelAt(along_m);
    // A drone does not follow each stone.
    return carrier == Carrier::kDrone ? level_m : galleries.FloorAt({p_m.x(), p_m.y(), level_m});
  };
  CarryAlong(scenario, carrier, way, floor, 1.1, options);
  scenario.lidar_model = "vlp16";
  scenario.ceiling_m = 1.0;
  scenario.dust_per_m = 0.003;
  SetBegin(scenario, options, 0.8);
  return scenario;
}

}  // namespace lio::sim
