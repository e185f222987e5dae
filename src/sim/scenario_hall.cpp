// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a sports hall with a hand-held sensor that is turned, tilted and swung at up to 300 deg/s.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lio/base/angle.hpp"
#include "scenario_parts.hpp"
#include "sim/unturned_pose.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfHallLength_m = 22.0;
constexpr double kHalfHallWidth_m = 13.5;
constexpr double kHallHeight_m = 8.5;
constexpr double kHallKnot_s = 0.1;
// This is the largest yaw rate; swinging adds the rest.
constexpr double kFastest_radps = 285.0 / 180.0 * std::numbers::pi;
constexpr double kRest_s = 2.5;

void AddShell(Mesh& mesh) {
  const double x = kHalfHallLength_m;
  const double y = kHalfHallWidth_m;
  AddQuad(mesh, {-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}, Material::kCourt);
  AddQuad(mesh, {-x, -y, kHallHeight_m}, {x, -y, kHallHeight_m}, {x, y, kHallHeight_m},
          {-x, y, kHallHeight_m}, Material::kMetal);
  for (const double side : {-1.0, 1.0}) {
    AddQuad(mesh, {-x, side * y, 0}, {x, side * y, 0}, {x, side * y, kHallHeight_m},
            {-x, side * y, kHallHeight_m}, Material::kPlaster);
    AddQuad(mesh, {side * x, -y, 0}, {side * x, y, 0}, {side * x, y, kHallHeight_m},
            {side * x, -y, kHallHeight_m}, Material::kBrick);
    for (double at = -x + 2.75; at < x; at += 5.5) {  // pillars, roof girders, high windows
      AddBox(mesh, At(at, side * (y - 0.2), 0), {0.45, 0.4, kHallHeight_m}, Material::kConcrete);
      AddBox(mesh, At(at + 2.75, side * (y - 0.03), 5.2), {3.6, 0.06, 2.2}, Material::kGlass);
    }
  }
  for (double at = -x + 2.75; at < x; at += 5.5) {
    AddBox(mesh, At(at, 0, kHallHeight_m - 0.9), {0.3, 2.0 * y, 0.25}, Material::kMetal);
    for (double b = -y; b < y; b += 1.5) {
      AddBar(mesh, {at, b, kHallHeight_m - 0.7}, {at, b + 0.75, kHallHeight_m}, 0.04, 0.04, 5,
             Material::kMetal);
    }
  }
}

void AddHoop(Mesh& mesh, double side) {
  const double x = side * (kHalfHallLength_m - 2.4);
  AddBar(mesh, {side * (kHalfHallLength_m - 0.6), 0, 0}, {side * (kHalfHallLength_m - 0.8), 0, 3.4},
         0.12, 0.1, 8, Material::kDarkMetal);
  AddBar(mesh, {side * (kHalfHallLength_m - 0.8), 0, 3.3}, {x, 0, 3.3}, 0.07, 0.06, 8,
         Material::kDarkMetal);
  AddBox(mesh, At(x, 0, 2.9), {0.04, 1.8, 1.05}, Material::kPlaster);
  AddBox(mesh, At(x - 0.35 * side, 0, 3.05), {0.45, 0.45, 0.03}, Material::kRetro);
}

void AddFittings(Mesh& mesh, Random& random) {
  for (const double side : {-1.0, 1.0}) AddHoop(mesh, side);
  for (int step = 0; step < 6; ++step) {  // the stand on one long side
    AddBox(mesh, At(0, -kHalfHallWidth_m + 5.1 - 0.85 * step, 0), {30.0, 0.85, 0.42 * (step + 1)},
           Material::kWood);
  }
  for (double x = -16.0; x < 16.0; x += 2.6) {  // the wall bars on the other side
    for (double z = 0.3; z < 2.7; z += 0.16) {
      AddBar(mesh, {x, kHalfHallWidth_m - 0.25, z}, {x + 2.2, kHalfHallWidth_m - 0.25, z}, 0.02,
             0.02, 5, Material::kWood);
    }
    AddBox(mesh, At(x, kHalfHallWidth_m - 0.2, 0.1), {0.08, 0.3, 2.7}, Material::kWood);
  }
  for (const double y : {-6.0, 7.0}) {
    AddBox(mesh, At(-kHalfHallLength_m + 0.04, y, 0.0), {0.08, 2.0, 2.2}, Material::kCarPaintDark);
    AddBox(mesh, At(kHalfHallLength_m - 0.04, -y, 0.0), {0.08, 1.2, 2.1}, Material::kCarPaintDark);
  }
  for (int i = 0; i < 5; ++i) {  // mats, boxes and a trolley
    const double height_m = random.Uniform(0.3, 1.3);
    const double width_m = random.Uniform(0.6, 1.2);
    const Vector3 size(random.Uniform(0.8, 2.0), width_m, height_m);
    const Material material = random.Chance(0.5) ? Material::kCloth : Material::kWood;
    const double heading = random.Uniform(0.0, std::numbers::pi);
    const Vector3 place = {random.Uniform(12.0, 19.0), random.Uniform(6.0, 11.0), 0.0};
    AddBox(mesh, UprightPose(place, heading), size, material);
  }
  for (int i = 0; i < 14; ++i) {
    const double x_m = random.Uniform(-14.0, 14.0);
    const double y_m = -kHalfHallWidth_m + 5.1 - 0.85 * (i % 5);
    AddMesh(mesh, MakePerson(random),
            UprightPose({x_m, y_m, 0.42 * (i % 5 + 1)}, 0.5 * std::numbers::pi));
  }
}

// Adds players who run in rounds on the halves of the court.
void AddPlayers(World& world, Random& random) {
  for (int i = 0; i < 6; ++i) {
    const double y_m = random.Uniform(-1.0, 5.0);
    const Vector2 middle((i % 2 == 0 ? -1.0 : 1.0) * random.Uniform(9.0, 13.0), y_m);
    const double radius_m = random.Uniform(2.0, 4.0);
    const double speed_mps = random.Uniform(1.5, 3.0);
    const double phase = random.Uniform(0.0, kTurn_rad);
    AddWalker(world, random, speed_mps, [=](double t_s) {
      const double angle = phase + speed_mps / radius_m * t_s;
      return UprightPose(
          {middle.x() + radius_m * std::cos(angle), middle.y() + radius_m * std::sin(angle), 0.0},
          angle + 0.5 * std::numbers::pi);
    });
  }
}

// Returns a motion that begins at rest and then has yaw rates that change every few seconds, with
// tilts and steps about.
std::vector<BodyKnot> SwingKnots(double duration_s, Random& random) {
  std::vector<BodyKnot> knots;
  double yaw = 0.0;
  double rate = 0.0;
  double target = 0.0;
  double next_change_s = kRest_s;
  const double a = random.Uniform(0.0, kTurn_rad);
  const double b = random.Uniform(0.0, kTurn_rad);
  for (double t_s = 0.0; t_s < duration_s + 1.0; t_s += kHallKnot_s) {
    if (t_s >= next_change_s) {
      constexpr std::array<double, 7> kRates = {0.35, -1.0, 0.1, 1.0, -0.5, 0.75, -0.2};
      target = kFastest_radps * kRates[static_cast<std::size_t>(random.Integer(0, 6))];
      next_change_s = t_s + random.Uniform(1.2, 3.0);
    }
    constexpr double kQuickest = 12.0;  // rad/s^2
    rate += std::clamp(target - rate, -kQuickest * kHallKnot_s, kQuickest * kHallKnot_s);
    yaw += rate * kHallKnot_s;
    BodyKnot knot;
    const double begun = std::clamp((t_s - kRest_s) / 4.0, 0.0, 1.0);
    const double strength = begun * begun * (3.0 - 2.0 * begun);
    const double w = kTurn_rad * t_s;
    knot.yaw_rad = yaw;
    knot.pitch_rad = strength * (0.30 * std::sin(0.31 * w + a) + 0.12 * std::sin(0.73 * w + b));
    knot.roll_rad = strength * (0.26 * std::sin(0.27 * w + b) + 0.12 * std::sin(0.61 * w + a));
    knot.position_m = {strength * 4.0 * std::sin(0.045 * w), strength * 2.6 * std::sin(0.07 * w),
                       strength * 0.12 * std::sin(0.5 * w)};
    knot.liveliness = 0.6 * strength;
    knots.push_back(knot);
  }
  return knots;
}

}  // namespace

Scenario MakeHall(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(45.0);
  Random random(options.seed, Purpose::kWorld, 11);
  AddShell(scenario.world.fixed.page());
  AddFittings(scenario.world.fixed.page(), random);
  AddPlayers(scenario.world, random);
  MotionPlan plan;
  plan.knot_interval_s = kHallKnot_s;
  Random motion(options.seed, Purpose::kMotion, 3);
  plan.knots = SwingKnots(PlannedSeconds(scenario, options), motion);
  for (const Oscillation& wave : WalkOscillations(options.seed)) {
    if (wave.axis != BodyAxis::kYaw) plan.oscillations.push_back(wave);
  }
  MountOnPerson(scenario, std::move(plan));
  scenario.ceiling_m = 3.0;
  SetBegin(scenario, options, 0.3);
  return scenario;
}

}  // namespace lio::sim
