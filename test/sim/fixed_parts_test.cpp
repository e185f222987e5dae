// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/fixed_parts.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lio::sim {
namespace {

constexpr double kReach_m = 110.0;
constexpr std::size_t kTrianglesOfBox = 12;

class FixedPartsTest : public ::testing::Test {
 protected:
  // A box each 50 m along x, from -1 km to 1 km.
  FixedPartsTest() {
    for (int i = -20; i <= 20; ++i) {
      AddBox(mesh_.page(), UprightPose({50.0 * i, 0.0, 0.0}, 0.0), {1, 1, 1}, Material::kBrick);
    }
  }
  DevicePtr device_ = MakeDevice();
  PagedMesh mesh_;
};

TEST_F(FixedPartsTest, ASmallMeshIsOnePart) {
  FixedParts parts(mesh_, kReach_m, mesh_.num_triangles(), device_.get());
  const FixedPartPtr part = parts.Around({0, 0, 0});
  EXPECT_EQ(part->materials.size(), mesh_.num_triangles());
  EXPECT_EQ(parts.Around({900, 0, 0}), part);
}

TEST_F(FixedPartsTest, AnEndlessReachNeedsAllOfALargeMesh) {
  FixedParts parts(mesh_, std::numeric_limits<double>::infinity(), 1, device_.get());
  EXPECT_EQ(parts.Around({0, 0, 0})->materials.size(), mesh_.num_triangles());
}

TEST_F(FixedPartsTest, APartIsACellOfALargeMeshAndWhatIsInReachOfIt) {
  FixedParts parts(mesh_, kReach_m, 1, device_.get());
  // The cell from 0 to 200 m reaches from -110 to 310 m: nine boxes.
  EXPECT_EQ(parts.Around({10, 0, 0})->materials.size(), 9 * kTrianglesOfBox);
  EXPECT_EQ(parts.Around({10, 0, 0}), parts.Around({190, 0, 0}));
  EXPECT_NE(parts.Around({10, 0, 0}), parts.Around({210, 0, 0}));
}

TEST_F(FixedPartsTest, TwoPartsAreKept) {
  FixedParts parts(mesh_, kReach_m, 1, device_.get());
  const std::weak_ptr<const FixedPart> first = parts.Around({10, 0, 0});
  const std::weak_ptr<const FixedPart> second = parts.Around({210, 0, 0});
  EXPECT_FALSE(first.expired());
  (void)parts.Around({410, 0, 0});
  EXPECT_TRUE(first.expired());
  EXPECT_FALSE(second.expired());
}

}  // namespace
}  // namespace lio::sim
