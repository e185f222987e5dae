// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/lidar_beams.hpp"

#include <gtest/gtest.h>

#include "support/beams.hpp"

namespace lio {
namespace {

TEST(LidarBeams, ARigWithoutBeamsKnowsNone) {
  EXPECT_TRUE(KnownBeams(LidarRig{}).std.rings.empty());
  EXPECT_FALSE(AsLidarBeams(BeamKnowledge{}));
}

TEST(LidarBeams, GoThereAndBack) {
  BeamKnowledge known = test::TwoKnownBeams();
  known.errors.rings[0].range_m = 0.0123456f;
  LidarRig rig;
  rig.beams = AsLidarBeams(known);
  ASSERT_TRUE(rig.beams);
  EXPECT_EQ(rig.beams->range_m[0], 0.012346);  // micrometres
  EXPECT_EQ(rig.beams->elevation_std_rad[1], 2e-4);
  EXPECT_EQ(rig.beams->encoder_rad[1], -5e-5);
  const BeamKnowledge back = KnownBeams(rig);
  ASSERT_EQ(back.errors.rings.size(), 2u);
  EXPECT_NEAR(back.errors.rings[0].range_m, 0.0123456f, 1e-6f);
  EXPECT_NEAR(back.errors.rings[1].azimuth_rad, 3e-4f, 1e-9f);
  EXPECT_NEAR(back.std.rings[0].elevation_rad, 1e-4f, 1e-9f);
  EXPECT_NEAR(back.std.encoder_rad.y(), 4e-5f, 1e-9f);
}

}  // namespace
}  // namespace lio
