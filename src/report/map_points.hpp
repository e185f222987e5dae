// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the map's points for the page: thinned to what a picture from above shows.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace lio {

inline constexpr std::size_t kMaxMapPoints = 60'000;

// Keeps the highest point in each cell seen from above; the cells grow until few enough are left.
// The result has "origin" [m], "step_m", "cell_m", "count" and "xyz": little-endian uint16 triples
// in base64, to be multiplied by step_m and added to the origin.
[[nodiscard]] nlohmann::ordered_json MapPointsJson(std::span<const Eigen::Vector3f> points);

[[nodiscard]] std::string Base64(std::span<const std::uint8_t> bytes);

}  // namespace lio
