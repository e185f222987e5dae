// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/embree.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

TEST(Embree, AMeshScenesTrianglesHaveTheMeshsNumbers) {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    AddTriangle(mesh, {10.0 * i, 0, 0}, {10.0 * i + 1, 0, 0}, {10.0 * i, 1, 0}, Material::kBrick);
  }
  const DevicePtr device = MakeDevice();
  const ScenePtr scene = MakeMeshScene(device.get(), mesh);
  RTCIntersectContext context;
  for (unsigned i = 0; i < 5; ++i) {
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = 10.0f * static_cast<float>(i) + 0.2f;
    ray.ray.org_y = 0.2f;
    ray.ray.org_z = 3.0f;
    ray.ray.dir_z = -1.0f;
    ray.ray.tfar = 10.0f;
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene.get(), &context, &ray);
    ASSERT_NE(ray.hit.geomID, RTC_INVALID_GEOMETRY_ID) << i;
    EXPECT_EQ(ray.hit.primID, i);
    EXPECT_FLOAT_EQ(ray.ray.tfar, 3.0f);
  }
}

TEST(Embree, AnEmptyMeshIsAScene) {
  const DevicePtr device = MakeDevice();
  EXPECT_NE(MakeMeshScene(device.get(), Mesh{}), nullptr);
}

}  // namespace
}  // namespace lio::sim
