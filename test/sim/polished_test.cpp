// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/polished.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

Hit HitOn(Material material, float range_m, float cos_incidence = 1.0f) {
  Hit hit;
  hit.range_m = range_m;
  hit.cos_incidence = cos_incidence;
  hit.material = material;
  hit.object = Hit::kFixed;
  return hit;
}

TEST(Polished, GlassReflectsLittleFromTheFrontAndAllAtGrazing) {
  EXPECT_NEAR(Reflectance(Material::kGlass, 1.0), 0.08, 1e-12);
  EXPECT_NEAR(Reflectance(Material::kCarPaint, 1.0), 0.04, 1e-12);
  EXPECT_NEAR(Reflectance(Material::kGlass, 0.0), 1.0, 1e-12);
}

TEST(Polished, PaintShowsOthersAtGrazingIncidenceOnly) {
  EXPECT_TRUE(MayShowOthers(HitOn(Material::kGlass, 5.0f, 1.0f)));
  EXPECT_FALSE(MayShowOthers(HitOn(Material::kCarPaint, 5.0f, 0.5f)));
  EXPECT_TRUE(MayShowOthers(HitOn(Material::kCarPaint, 5.0f, 0.02f)));
  EXPECT_FALSE(MayShowOthers(HitOn(Material::kBrick, 5.0f, 0.02f)));
}

TEST(Polished, AWallCloseBehindAWindowIsSeenThroughIt) {
  const Hit window = HitOn(Material::kGlass, 20.0f, 0.9f);
  const Echo echo = EchoOfPolished(window, {Hit(), HitOn(Material::kPlaster, 2.0f)});
  EXPECT_EQ(echo.kind, EchoKind::kThroughGlass);
  EXPECT_NEAR(echo.range_m, 22.0 + kPolish.pane_m, 1e-5);
  EXPECT_LT(echo.strength, 0.3);
  EXPECT_EQ(echo.surface.material, Material::kPlaster);
}

TEST(Polished, AWallFarBehindAWindowIsNot) {
  const Hit window = HitOn(Material::kGlass, 5.0f, 0.9f);
  const Echo echo = EchoOfPolished(window, {Hit(), HitOn(Material::kPlaster, 20.0f)});
  EXPECT_EQ(echo.kind, EchoKind::kSurface);
  EXPECT_EQ(echo.range_m, 5.0);
}

TEST(Polished, AtGrazingIncidenceTheMirrorImageLiesBehindTheMirror) {
  const Hit window = HitOn(Material::kGlass, 10.0f, 0.1f);
  const Echo echo = EchoOfPolished(window, {HitOn(Material::kPlaster, 6.0f), Hit()});
  EXPECT_EQ(echo.kind, EchoKind::kMirrored);
  EXPECT_NEAR(echo.range_m, 16.0, 1e-6);
}

}  // namespace
}  // namespace lio::sim
