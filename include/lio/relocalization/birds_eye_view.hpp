// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where things stand in a scan, seen from above: what a velocity or a place is sought with before
// matching can tell. Ground is left out, since a spinning lidar's rings on it move with the sensor.
// Points in metres, in axes whose z is up to about 10 deg, origin at the sensor; what is within 60
// m of it to each side counts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lio {

class BirdsEyeView {
 public:
  explicit BirdsEyeView(std::span<const Eigen::Vector3f> points);

  // One point a column, at most a few hundred, evenly chosen; none of a line, a wall or a rail,
  // unless there is little else.
  const std::vector<Eigen::Vector2f>& places() const { return places_; }
  // How many of these places, moved by `shift`, have something standing within about a quarter of
  // a metre?
  int NumNear(std::span<const Eigen::Vector2f> places, const Eigen::Vector2f& shift) const;
  // The same within one to two metres.
  int NumRoughlyNear(std::span<const Eigen::Vector2f> places, const Eigen::Vector2f& shift) const;
  // Do enough things stand there to lay it over another view?
  bool SaysEnough() const;

 private:
  bool IsNear(const Eigen::Vector2f& place) const;
  // Do things stand in a row to both sides of there?
  bool IsOnLine(const Eigen::Vector2f& place) const;

  std::vector<Eigen::Vector2f> places_;
  std::vector<std::uint8_t> near_;          // by cell of a square around the origin
  std::vector<std::uint8_t> roughly_near_;  // the same, of larger cells
};

// At most `max` of them, evenly over their order.
std::vector<Eigen::Vector2f> EvenlyChosen(const std::vector<Eigen::Vector2f>& places,
                                          std::size_t max);

}  // namespace lio
