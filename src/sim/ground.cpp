// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lio::sim {
namespace {

constexpr double kCoarseCell_m = 6.0;
constexpr double kCoarseDrop_m =
    0.06;  // the coarse mesh lies this much lower, so that the fine one hides it

constexpr std::size_t kPieceSegments = 16;
constexpr double kRounding = 1e-4;  // m or m^2, far above the rounding of distances

double SquaredDistanceToSegment(const Vector2& p, const Vector2& from, const Vector2& to) {
  const Vector2 d = to - from;
  const double t = std::clamp((p - from).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - from - t * d).squaredNorm();
}

Eigen::AlignedBox2d BoxOf(const Vector2* points, std::size_t num) {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < num; ++i) box.extend(points[i]);
  return box;
}

Eigen::AlignedBox2d BoundsOf(const RoadNetwork& network, double reach_m) {
  Eigen::AlignedBox2d bounds;
  for (const Road& road : network.roads())
    bounds.extend(BoxOf(road.line_m.data(), road.line_m.size()));
  const Vector2 reach = Vector2::Constant(reach_m);
  return {bounds.min() - reach, bounds.max() + reach};
}

// Holds a corner of the lattice.
struct GroundCorner {
  Vector2 p;
  double distance = 0.0;  // signed, to the road's edge
  double height = 0.0;    // height of the terrain
};

// Writes the cells of the lattice, cut along the kerb.
class GroundWriter {
 public:
  GroundWriter(PagedMesh& mesh, const GroundOptions& options) : mesh_(mesh), options_(options) {}

  void AddCell(const std::array<GroundCorner, 4>& corners) {
    std::vector<GroundCorner> road;
    std::vector<GroundCorner> verge;
    std::vector<GroundCorner> edge;
    for (std::size_t i = 0; i < 4; ++i) {
      const GroundCorner& a = corners[i];
      const GroundCorner& b = corners[(i + 1) % 4];
      (a.distance < 0.0 ? road : verge).push_back(a);
      if ((a.distance < 0.0) == (b.distance < 0.0)) continue;
      const double t = a.distance / (a.distance - b.distance);
      const GroundCorner cut{a.p + t * (b.p - a.p), 0.0, a.height + t * (b.height - a.height)};
      road.push_back(cut);
      verge.push_back(cut);
      edge.push_back(cut);
    }
    AddFan(road, 0.0, options_.road);
    double middle = 0.0;
    for (const GroundCorner& c : corners) middle += 0.25 * c.distance;
    AddFan(verge, options_.kerb_m,
           middle < options_.pavement_m ? options_.pavement : options_.beyond);
    for (std::size_t i = 0; i + 1 < edge.size() && options_.kerb_m > 0.0; i += 2) {
      AddQuad(mesh_.page(), At(edge[i], 0.0), At(edge[i + 1], 0.0),
              At(edge[i + 1], options_.kerb_m), At(edge[i], options_.kerb_m), Material::kConcrete);
    }
  }

 private:
  static Vector3 At(const GroundCorner& c, double raise) {
    return {c.p.x(), c.p.y(), c.height + raise};
  }
  void AddFan(const std::vector<GroundCorner>& polygon, double raise, Material material) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      AddTriangle(mesh_.page(), At(polygon[0], raise), At(polygon[i], raise),
                  At(polygon[i + 1], raise), material);
    }
  }

  PagedMesh& mesh_;
  const GroundOptions& options_;
};

// Calls `add(corners)` for each cell of a lattice whose corners are within `reach`.
template <typename Add>
void ForEachCell(const Terrain& terrain, const RoadNetwork& network, double cell_m, double reach_m,
                 const Add& add) {
  const Eigen::AlignedBox2d bounds = BoundsOf(network, reach_m);
  const auto nx = static_cast<std::size_t>(bounds.sizes().x() / cell_m) + 1;
  const auto ny = static_cast<std::size_t>(bounds.sizes().y() / cell_m) + 1;
  const auto make_row = [&](std::size_t iy) {
    std::vector<GroundCorner> row(nx + 1);
    double within_m = -1e9;  // the corner is at least this far
    for (std::size_t ix = 0; ix <= nx; ++ix, within_m -= cell_m) {
      GroundCorner& c = row[ix];
      c.p = bounds.min() + cell_m * Vector2(static_cast<double>(ix), static_cast<double>(iy));
      // The distance changes by no more than the way to the next corner.
      if (within_m < reach_m + kRounding) within_m = network.SignedDistance(c.p);
      c.distance = within_m;
      c.height = c.distance < reach_m ? terrain.Height(c.p) : 0.0;
    }
    return row;
  };
  std::vector<GroundCorner> below = make_row(0);
  for (std::size_t iy = 0; iy < ny; ++iy) {
    std::vector<GroundCorner> above = make_row(iy + 1);
    for (std::size_t ix = 0; ix < nx; ++ix) {
      const std::array<GroundCorner, 4> cell = {below[ix], below[ix + 1], above[ix + 1], above[ix]};
      const bool near = std::all_of(cell.begin(), cell.end(),
                                    [&](const GroundCorner& c) { return c.distance < reach_m; });
      if (near) add(cell);
    }
    below = std::move(above);
  }
}

}  // namespace

Terrain::Terrain(const Shape& shape, Random& random) : shape_(shape) {
  const auto add = [&](int num, double shortest_m, double longest_m, double amplitude_m) {
    for (int i = 0; i < num; ++i) {
      const double length_m = random.Uniform(shortest_m, longest_m);
      const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
      const double k = 2.0 * std::numbers::pi / length_m;
      waves_.push_back({{k * std::cos(angle), k * std::sin(angle)},
                        amplitude_m * random.Uniform(0.5, 1.0) / std::sqrt(num),
                        random.Uniform(0.0, 2.0 * std::numbers::pi)});
    }
  };
  add(4, 60.0, 250.0, shape.hill_m);
  add(5, 5.0, 15.0, shape.bump_m);
}

double Terrain::Height(const Vector2& p_m) const {
  double height_m = shape_.slope_ratio.dot(p_m);
  for (const Wave& wave : waves_) {
    height_m += wave.amplitude_m * std::sin(wave.wave_vector_per_m.dot(p_m) + wave.phase_rad);
  }
  return height_m;
}

RoadNetwork::RoadNetwork(std::vector<Road> roads, double rounding_m)
    : roads_(std::move(roads)), rounding_m_(rounding_m) {
  for (const Road& road : roads_) {
    const std::vector<Vector2>& line = road.line_m;
    boxes_.push_back({BoxOf(line.data(), line.size()), {}});
    for (std::size_t first = 0; first + 1 < line.size(); first += kPieceSegments) {
      const std::size_t num = std::min(kPieceSegments + 1, line.size() - first);
      boxes_.back().pieces.push_back(BoxOf(line.data() + first, num));
    }
  }
}

double RoadNetwork::DistanceToLine(std::size_t road, const Vector2& p_m) const {
  const std::vector<Vector2>& line = roads_[road].line_m;
  const std::vector<Eigen::AlignedBox2d>& pieces = boxes_[road].pieces;
  double best_sq = 1e18;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].squaredExteriorDistance(p_m) > best_sq + kRounding) continue;
    const std::size_t last = std::min((k + 1) * kPieceSegments, line.size() - 1);
    for (std::size_t i = k * kPieceSegments; i < last; ++i) {
      best_sq = std::min(best_sq, SquaredDistanceToSegment(p_m, line[i], line[i + 1]));
    }
  }
  return std::sqrt(best_sq);
}

double RoadNetwork::SignedDistance(const Vector2& p_m) const {
  // This is a polynomial smooth minimum (Quilez): it equals the minimum where one road is clearly
  // nearest.
  double result = 1e9;
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    const double reach_m = result + rounding_m_ + roads_[i].half_width_m;
    if (boxes_[i].whole.exteriorDistance(p_m) > reach_m + kRounding) continue;
    const double d = DistanceToLine(i, p_m) - roads_[i].half_width_m;
    const double h = std::max(rounding_m_ - std::abs(result - d), 0.0) / rounding_m_;
    result = std::min(result, d) - 0.25 * h * h * rounding_m_;
  }
  return result;
}

void AddGround(PagedMesh& mesh, const Terrain& terrain, const RoadNetwork& network,
               const GroundOptions& options) {
  GroundWriter writer(mesh, options);
  ForEachCell(terrain, network, options.cell_m, options.reach_m,
              [&](const std::array<GroundCorner, 4>& cell) { writer.AddCell(cell); });
  const auto far = [&](std::array<GroundCorner, 4> cell) {
    const double inner = options.reach_m - 2.0 * kCoarseCell_m;
    if (std::all_of(cell.begin(), cell.end(),
                    [&](const GroundCorner& c) { return c.distance < inner; })) {
      return;
    }
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] << cell[i].p, cell[i].height + options.kerb_m - kCoarseDrop_m;
    }
    AddQuad(mesh.page(), p[0], p[1], p[2], p[3], options.beyond);
  };
  if (options.far_reach_m > options.reach_m) {
    ForEachCell(terrain, network, kCoarseCell_m, options.far_reach_m, far);
  }
}

}  // namespace lio::sim
