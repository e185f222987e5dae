// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/mover_scene.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

constexpr double kReach_m = 50.0;

class MoverScenesTest : public ::testing::Test {
 protected:
  // A long box that rests at the origin, and one that turns, 200 m along x.
  MoverScenesTest() {
    Mesh box;
    AddBox(box, Pose{}, {20, 2, 2}, Material::kCarPaint);
    world_.shapes = {box, box};
    world_.movers.push_back({0, [](double) { return Pose{}; }});
    world_.movers.push_back({1, [](double t_s) { return UprightPose({200, 0, 0}, t_s); }});
  }
  // Whether a ray from above the place meets something.
  static bool IsThere(const MoverScene& movers, double x_m) {
    if (!movers.scene) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(x_m);
    ray.org_z = 50.0f;
    ray.dir_z = -1.0f;
    ray.tfar = 100.0f;
    ray.mask = ~0u;
    rtcOccluded1(movers.scene.get(), &context, &ray);
    return ray.tfar < 0.0f;  // so Embree marks a ray that is stopped
  }
  DevicePtr device_ = MakeDevice();
  World world_;
};

TEST_F(MoverScenesTest, ShowWhatComesWithinReach) {
  MoverScenes scenes(world_, kReach_m, device_.get());
  const MoverScene at_first = scenes.During(0.0, 0.1, {0, 0, 0});
  EXPECT_TRUE(IsThere(at_first, 0.0));
  EXPECT_FALSE(IsThere(at_first, 200.0));
  const MoverScene at_second = scenes.During(0.0, 0.1, {200, 0, 0});
  EXPECT_FALSE(IsThere(at_second, 0.0));
  EXPECT_TRUE(IsThere(at_second, 200.0));
}

TEST_F(MoverScenesTest, AShapeReachesAsFarAsItsFarthestCorner) {
  MoverScenes scenes(world_, kReach_m, device_.get());
  EXPECT_TRUE(IsThere(scenes.During(0.0, 0.1, {59, 0, 0}), 0.0)) << "its end is 49 m away";
  EXPECT_EQ(scenes.During(0.0, 0.1, {100, 0, 0}).scene, nullptr);
}

TEST_F(MoverScenesTest, TellHowMoversAreTurnedAtTheMiddle) {
  MoverScenes scenes(world_, kReach_m, device_.get());
  const MoverScene movers = scenes.During(1.0, 1.2, {200, 0, 0});
  ASSERT_EQ(movers.R_mover_world.size(), 2u);
  const Matrix3 R_world_mover = UprightPose({}, 1.1).rotation.toRotationMatrix();
  EXPECT_TRUE((movers.R_mover_world[1] * R_world_mover).isIdentity(1e-12));
}

// A shape that was out of sight for long is made anew; who still casts into the old one keeps it.
TEST_F(MoverScenesTest, OutlastTheShapesThatAreDropped) {
  MoverScenes scenes(world_, kReach_m, device_.get());
  const MoverScene before = scenes.During(0.0, 0.1, {0, 0, 0});
  for (int i = 0; i < 10; ++i) (void)scenes.During(0.0, 0.1, {200, 0, 0});
  EXPECT_EQ(scenes.num_shapes(), 2u);
  for (int i = 0; i < 90; ++i) (void)scenes.During(0.0, 0.1, {200, 0, 0});
  EXPECT_EQ(scenes.num_shapes(), 1u);
  EXPECT_TRUE(IsThere(before, 0.0));
  EXPECT_TRUE(IsThere(scenes.During(0.0, 0.1, {0, 0, 0}), 0.0));
}

}  // namespace
}  // namespace lio::sim
