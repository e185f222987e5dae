// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows the vertical structures of a scan (posts, trees, walls, cars), seen from above. Two views
// laid over each other tell a velocity or a place before matching can. Ground is left out, since a
// spinning lidar's rings on it move with the sensor. Points are in metres, in axes whose z is up to
// about 10 deg, with the origin at the sensor; those within 60 m of it to each side count.
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
  // Shows those alone that are so high from their lowest point to their highest.
  BirdsEyeView(std::span<const Eigen::Vector3f> points, float min_height_m);

  // Returns one point for each structure, at most a few hundred, evenly chosen. Structures in a
  // row, as of a wall or a rail, are left out unless there are few others.
  const std::vector<Eigen::Vector2f>& structures() const { return structures_; }
  // How many of these structures, moved by `shift`, have one of this view within about a quarter of
  // a metre.
  [[nodiscard]] int NumNear(std::span<const Eigen::Vector2f> structures,
                            const Eigen::Vector2f& shift) const;
  // Counts the same within one to two metres.
  [[nodiscard]] int NumRoughlyNear(std::span<const Eigen::Vector2f> structures,
                                   const Eigen::Vector2f& shift) const;
  // Are there enough structures to lay the view over another one?
  [[nodiscard]] bool HasEnoughStructures() const;

 private:
  bool IsNear(float x, float y) const;
  bool IsRoughlyNear(float x, float y) const;
  // Do structures stand in a row to both sides of there?
  bool IsOnLine(const Eigen::Vector2f& point) const;

  std::vector<Eigen::Vector2f> structures_;
  std::vector<std::uint8_t> near_;          // by cell of a square around the origin
  std::vector<std::uint8_t> roughly_near_;  // the same, of larger cells
};

// Returns at most `max` of them, evenly over their order.
[[nodiscard]] std::vector<Eigen::Vector2f> SpreadEvenly(
    const std::vector<Eigen::Vector2f>& structures, std::size_t max);

}  // namespace lio
