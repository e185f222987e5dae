// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace lio::sim {
namespace {

constexpr double kStraight_per_m = 1e-9;  // a path flatter than this is a straight

double WrapAngle(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

double HeadingOf(const Vector2& step) {
  return std::atan2(step.y(), step.x());
}

}  // namespace

Path::Path(const Vector2& start_m, double heading_rad) {
  end_.position_m = start_m;
  end_.heading_rad = heading_rad;
}

Path Path::Rounded(const std::vector<Vector2>& waypoints_m, double radius_m, bool closed) {
  std::vector<Vector2> points = waypoints_m;
  if (closed) points.push_back(points.front());
  if (points.size() < 2) throw std::invalid_argument("Path: at least two waypoints are needed");
  Path path(points.front(), HeadingOf(points[1] - points[0]));
  double used_m = 0.0;  // length of the present leg that the corner before it takes
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector2 leg = points[i] - points[i - 1];
    const bool last = i + 1 == points.size();
    const double turn =
        last ? 0.0 : WrapAngle(HeadingOf(points[i + 1] - points[i]) - HeadingOf(leg));
    const double cut_m = radius_m * std::tan(0.5 * std::abs(turn));
    const double straight_m = leg.norm() - used_m - cut_m;
    if (straight_m < 0.0) throw std::invalid_argument("Path: corners overlap");
    path.AddStraight(straight_m);
    if (turn != 0.0) path.AddArc(radius_m, turn);
    used_m = cut_m;
  }
  return path;
}

void Path::AddStraight(double length_m) {
  Add(length_m, 0.0);
}

void Path::AddArc(double radius_m, double angle_rad) {
  Add(radius_m * std::abs(angle_rad), (angle_rad < 0.0 ? -1.0 : 1.0) / radius_m);
}

void Path::Add(double length_m, double curvature_per_m) {
  if (!(length_m > 0.0)) return;
  Piece piece{length_m_, length_m, end_};
  piece.begin.curvature_per_m = curvature_per_m;
  end_ = Along(piece, length_m);
  length_m_ += length_m;
  pieces_.push_back(piece);
}

PathPoint Path::Along(const Piece& piece, double distance_m) {
  const double k = piece.begin.curvature_per_m;
  PathPoint point = piece.begin;
  point.heading_rad += k * distance_m;
  if (std::abs(k) < kStraight_per_m) {
    point.position_m += distance_m * piece.begin.Forward();
  } else {
    point.position_m += (piece.begin.Left() - point.Left()) / k;
  }
  return point;
}

PathPoint Path::At(double distance_m) const {
  if (pieces_.empty() || distance_m >= length_m_) {
    PathPoint point = end_;
    point.position_m += (distance_m - length_m_) * end_.Forward();
    point.curvature_per_m = 0.0;
    return point;
  }
  if (distance_m < 0.0) {
    PathPoint point = pieces_.front().begin;
    point.position_m += distance_m * point.Forward();
    point.curvature_per_m = 0.0;
    return point;
  }
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance_m,
                                      [](double d, const Piece& p) { return d < p.start_m; });
  const Piece& piece = *std::prev(after);
  return Along(piece, distance_m - piece.start_m);
}

PathPoint Path::Beside(double distance_m, double left_m) const {
  PathPoint point = At(distance_m);
  point.position_m += left_m * point.Left();
  return point;
}

Path Path::Cut(double from_m, double to_m) const {
  const PathPoint start = At(from_m);
  Path path(start.position_m, start.heading_rad);
  for (const Piece& piece : pieces_) {
    const double begin = std::max(from_m, piece.start_m);
    const double end = std::min(to_m, piece.start_m + piece.length_m);
    path.Add(end - begin, piece.begin.curvature_per_m);
  }
  return path;
}

Path Path::Shifted(double left_m) const {
  const PathPoint start = Beside(0.0, left_m);
  Path path(start.position_m, start.heading_rad);
  for (const Piece& piece : pieces_) {
    const double stretch = 1.0 - left_m * piece.begin.curvature_per_m;
    path.Add(piece.length_m * stretch, piece.begin.curvature_per_m / stretch);
  }
  return path;
}

Path Path::Reversed() const {
  Path path(end_.position_m, end_.heading_rad + std::numbers::pi);
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece) {
    path.Add(piece->length_m, -piece->begin.curvature_per_m);
  }
  return path;
}

Path Path::Repeated(int times) const {
  Path path = Cut(0.0, 0.0);
  for (int i = 0; i < times; ++i) {
    for (const Piece& piece : pieces_) path.Add(piece.length_m, piece.begin.curvature_per_m);
  }
  return path;
}

std::vector<Vector2> Path::Sampled(double step_m) const {
  const int num_steps = std::max(1, static_cast<int>(std::ceil(length_m_ / step_m)));
  std::vector<Vector2> points;
  points.reserve(static_cast<std::size_t>(num_steps) + 1);
  for (int i = 0; i <= num_steps; ++i) points.push_back(At(length_m_ * i / num_steps).position_m);
  return points;
}

}  // namespace lio::sim
