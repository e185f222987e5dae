// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the carriers in the two places that take all of them.
#include "sim/carrier.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <ostream>
#include <string_view>

#include "lio/sim/scene.hpp"

namespace lio::sim {
namespace {

struct Ride {
  std::string place;
  Carrier carrier;
};

void PrintTo(const Ride& ride, std::ostream* out) {
  constexpr std::array<std::string_view, 3> kNames = {"person", "robot", "drone"};
  *out << ride.place << " by " << kNames.at(static_cast<std::size_t>(ride.carrier));
}

class Carriers : public ::testing::TestWithParam<Ride> {
 protected:
  static Scenario Make() {
    ScenarioOptions options;
    options.carrier = GetParam().carrier;
    options.duration_s = 40.0;
    return MakeScenario(GetParam().place, options);
  }
};

TEST_P(Carriers, KeepToTheirLimits) {
  const Scenario scenario = Make();
  double fastest_mps = 0.0;
  double hardest_mps2 = 0.0;
  double fastest_radps = 0.0;
  for (double t_s = 0.0; t_s < scenario.duration_s; t_s += 0.01) {
    const Kinematics k = scenario.trajectory->At(t_s);
    fastest_mps = std::max(fastest_mps, k.v_world_mps.norm());
    hardest_mps2 = std::max(hardest_mps2, k.a_world_mps2.norm());
    fastest_radps = std::max(fastest_radps, k.w_imu_radps.norm());
  }
  const bool flies = GetParam().carrier == Carrier::kDrone;
  EXPECT_LT(fastest_mps, flies ? 7.0 : 2.5);
  EXPECT_LT(hardest_mps2, flies ? 14.0 : 12.0);
  EXPECT_LT(fastest_radps, flies ? 4.5 : 3.0);
  if (!flies) return;
  EXPECT_GT(fastest_mps, 3.5);
  // A straight lane asks for less than bends do.
  const bool is_straight = GetParam().place == "hedgerows";
  EXPECT_GT(hardest_mps2, is_straight ? 3.5 : 6.0);
  EXPECT_GT(fastest_radps, (is_straight ? 145.0 : 150.0) / 180.0 * std::numbers::pi);
}

// Rays go from the sensor to each side and up; nothing but movers may be nearer than half a metre,
// and the floor is as far below as the carrier is high.
TEST_P(Carriers, AreInFreeSpaceAboveTheFloor) {
  const Scenario scenario = Make();
  const Scene scene(scenario.world);
  for (double t_s = 0.2; t_s < scenario.duration_s; t_s += 0.3) {
    const auto interval = scene.During(t_s - 0.05, t_s + 0.05);
    const Vector3 sensor =
        scenario.trajectory->At(t_s).T_world_imu * scenario.T_imu_lidar.translation;
    const auto cast = [&](const Vector3& direction) {
      const Ray ray{sensor.cast<float>(), direction.normalized().cast<float>(), 0.5f};
      Hit hit;
      interval.Cast({&ray, 1}, 100.0f, {&hit, 1});
      return hit;
    };
    for (int i = 0; i < 8; ++i) {
      const double angle = i * std::numbers::pi / 4.0;
      const Hit hit = cast({std::cos(angle), std::sin(angle), 0.3});
      EXPECT_TRUE(hit.object != Hit::kFixed || hit.range_m > 0.45f) << t_s << " s, " << i;
    }
    EXPECT_GT(cast(Vector3::UnitZ()).range_m, 0.3f) << t_s;
    const Vector3 feet = scenario.trajectory->BodyPoseAt(t_s).translation;
    const Ray down{(feet + Vector3(0.0, 0.0, 0.3)).cast<float>(), -Vector3f::UnitZ(), 0.5f};
    Hit floor;
    interval.Cast({&down, 1}, 100.0f, {&floor, 1});
    EXPECT_LT(floor.range_m, GetParam().carrier == Carrier::kDrone ? 3.2f : 0.5f) << t_s;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Carriers,
    ::testing::Values(Ride{"mine", Carrier::kPerson}, Ride{"mine", Carrier::kRobot},
                      Ride{"mine", Carrier::kDrone}, Ride{"warehouse", Carrier::kPerson},
                      Ride{"warehouse", Carrier::kRobot}, Ride{"warehouse", Carrier::kDrone},
                      Ride{"hedgerows", Carrier::kPerson}, Ride{"hedgerows", Carrier::kRobot},
                      Ride{"hedgerows", Carrier::kDrone}));

}  // namespace
}  // namespace lio::sim
