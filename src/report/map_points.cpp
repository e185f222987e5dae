// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "map_points.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lio {
namespace {

constexpr double kFinestCell_m = 0.2;  // the map has no more than a point in so much
constexpr double kCoarser = 1.4;

std::uint64_t CellOf(const Eigen::Vector3f& point, double cell_m) {
  const auto index = [cell_m](float x) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(double{x} / cell_m)));
  };
  return (std::uint64_t{index(point.x())} << 32) | index(point.y());
}

// Gives nothing when more than kMaxMapPoints would be left.
std::vector<Eigen::Vector3f> Thinned(std::span<const Eigen::Vector3f> points, double cell_m) {
  std::unordered_map<std::uint64_t, std::size_t> place_of_cell;
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3f& point : points) {
    const auto [place, is_new] = place_of_cell.emplace(CellOf(point, cell_m), kept.size());
    if (!is_new) {
      Eigen::Vector3f& other = kept[place->second];
      if (point.z() > other.z()) other = point;
      continue;
    }
    if (kept.size() == kMaxMapPoints) return {};
    kept.push_back(point);
  }
  return kept;
}

std::vector<Eigen::Vector3f> FinitePoints(std::span<const Eigen::Vector3f> points) {
  constexpr float kFarthest_m = 1e6f;
  std::vector<Eigen::Vector3f> finite;
  for (const Eigen::Vector3f& point : points) {
    if (point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest_m) finite.push_back(point);
  }
  return finite;
}

}  // namespace

std::string Base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t num = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = (bits << 8) | (k < num ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= num ? kLetters[(bits >> (18 - 6 * k)) & 63] : '=';
    }
  }
  return text;
}

nlohmann::ordered_json MapPointsJson(std::span<const Eigen::Vector3f> points) {
  const std::vector<Eigen::Vector3f> finite = FinitePoints(points);
  if (finite.empty()) return nullptr;
  double cell_m = kFinestCell_m;
  std::vector<Eigen::Vector3f> kept = Thinned(finite, cell_m);
  while (kept.empty()) kept = Thinned(finite, cell_m *= kCoarser);
  Eigen::Vector3f low = kept[0], high = kept[0];
  for (const Eigen::Vector3f& point : kept) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const float step_m = std::max(1e-3f, (high - low).maxCoeff() / 65535.0f);
  std::vector<std::uint8_t> bytes;
  for (const Eigen::Vector3f& point : kept) {
    for (const float offset_m : Eigen::Vector3f(point - low)) {
      const auto steps = static_cast<std::uint16_t>(std::min(65535.0f, offset_m / step_m + 0.5f));
      bytes.push_back(static_cast<std::uint8_t>(steps & 0xff));
      bytes.push_back(static_cast<std::uint8_t>(steps >> 8));
    }
  }
  return {{"origin", {low.x(), low.y(), low.z()}},
          {"step_m", step_m},
          {"cell_m", cell_m},
          {"count", kept.size()},
          {"xyz", Base64(bytes)}};
}

}  // namespace lio
