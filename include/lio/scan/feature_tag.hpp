// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The kind of feature a point belongs to, for methods that distinguish features (LOAM).
#pragma once

#include <cstdint>

namespace lio {

enum class FeatureKind : std::uint8_t { kSharp, kLessSharp, kFlat, kLessFlat };

struct FeatureTag {
  FeatureKind kind = FeatureKind::kLessFlat;
  std::uint16_t ring = 0;

  bool IsEdge() const { return kind == FeatureKind::kSharp || kind == FeatureKind::kLessSharp; }
};

}  // namespace lio
