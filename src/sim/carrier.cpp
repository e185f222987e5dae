// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "carrier.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lio/base/angle.hpp"

namespace lio::sim {
namespace {

BodyResponse ResponseOf(Carrier carrier) {
  BodyResponse response;
  switch (carrier) {
    case Carrier::kPerson:
      response = {0.0, 0.01, 0.0, 0.0, 1.0};
      break;
    case Carrier::kRobot:
      response = {0.004, 0.006, 0.2, 0.29, 1.2};
      break;
    case Carrier::kDrone:  // its rotors' thrust is along its z axis
      response = {-1.0 / 9.81, -1.0 / 9.81, 0.0, 0.0, 1.0};
      break;
  }
  return response;
}

struct Band {
  BodyAxis axis;
  double amplitude;
  double low_hz;
  double high_hz;
};

std::vector<Oscillation> Waves(std::uint64_t seed, const std::vector<Band>& bands) {
  Random random(seed, Purpose::kMotion, 5);
  std::vector<Oscillation> waves;
  for (const Band& band : bands) {
    const double amplitude = band.amplitude * random.Uniform(0.7, 1.3);
    const double frequency_hz = random.Uniform(band.low_hz, band.high_hz);
    waves.push_back({band.axis, amplitude, frequency_hz, random.Uniform(0.0, kTurn_rad)});
  }
  return waves;
}

std::vector<Oscillation> OscillationsOf(Carrier carrier, std::uint64_t seed) {
  using A = BodyAxis;
  switch (carrier) {
    case Carrier::kPerson:
      return WalkOscillations(seed);
    case Carrier::kRobot:
      return Waves(seed, {{A::kZ, 0.0015, 8.0, 14.0},
                          {A::kZ, 0.003, 2.5, 4.0},
                          {A::kPitch, 0.004, 5.0, 9.0},
                          {A::kRoll, 0.004, 4.0, 8.0},
                          {A::kYaw, 0.02, 0.3, 0.6}});
    case Carrier::kDrone:
      return Waves(seed, {{A::kX, 0.04, 0.4, 0.9},
                          {A::kY, 0.04, 0.4, 0.9},
                          {A::kZ, 0.05, 0.3, 0.7},
                          {A::kPitch, 0.02, 1.5, 3.0},
                          {A::kRoll, 0.02, 1.5, 3.0},
                          {A::kPitch, 0.003, 8.0, 12.0},
                          {A::kRoll, 0.003, 8.0, 12.0}});
  }
  return {};
}

// Returns the way of a drone's feet: it climbs over the first metres and changes its height by a
// sixth of it later.
HeightFunction FlightAbove(const HeightFunction& floor, double flight_m) {
  constexpr double kClimb_m = 3.0;
  constexpr double kWave_m = 17.0;
  return [=](const Vector2& p_m, double along_m) {
    const double climbed = std::clamp(along_m / kClimb_m, 0.0, 1.0);
    const double eased = climbed * climbed * (3.0 - 2.0 * climbed);
    const double wave = 1.0 + std::sin(kTurn_rad * along_m / kWave_m) / 6.0;
    return floor(p_m, along_m) + flight_m * eased * wave;
  };
}

}  // namespace

DriveLimits LimitsOf(Carrier carrier) {
  switch (carrier) {
    case Carrier::kPerson:
      return {1.2, 0.7, 0.9, 0.5};
    case Carrier::kRobot:
      return {1.5, 1.0, 1.5, 0.8};
    case Carrier::kDrone:
      return {4.5, 3.0, 3.5, 3.5};
  }
  return {};
}

void AddGlances(std::vector<BodyKnot>& knots, double knot_interval_s, double fastest_radps,
                Random& random) {
  double begin_s = kStartRest_s + 1.5;
  const double end_s = knot_interval_s * static_cast<double>(knots.size());
  while (begin_s < end_s) {
    const double length_s = random.Uniform(1.1, 1.5);
    const double sign = random.Chance(0.5) ? 1.0 : -1.0;
    const double turn_rad =
        sign * random.Uniform(0.6, 1.0) * fastest_radps * length_s / std::numbers::pi;
    const double tilt_rad = random.Uniform(-0.3, 0.3);
    for (std::size_t i = 0; i < knots.size(); ++i) {
      const double share = (knot_interval_s * static_cast<double>(i) - begin_s) / length_s;
      if (share <= 0.0 || share >= 1.0) continue;
      const double wave = std::sin(std::numbers::pi * share);
      knots[i].yaw_rad += turn_rad * wave * wave * knots[i].liveliness;
      knots[i].pitch_rad += tilt_rad * wave * wave * knots[i].liveliness;
    }
    begin_s += length_s + random.Uniform(1.0, 3.0);
  }
}

void CarryAlong(Scenario& scenario, Carrier carrier, const Path& way, const HeightFunction& floor,
                double flight_m, const ScenarioOptions& options) {
  const Drive drive(way, LimitsOf(carrier), {}, kStartRest_s);
  const bool flies = carrier == Carrier::kDrone;
  MotionPlan plan;
  plan.knot_interval_s = kCarrierKnot_s;
  plan.knots = FollowDrive(way, drive, flies ? FlightAbove(floor, flight_m) : floor,
                           ResponseOf(carrier), kCarrierKnot_s, PlannedSeconds(scenario, options));
  plan.oscillations = OscillationsOf(carrier, options.seed);
  Random motion(options.seed, Purpose::kMotion, 4);
  if (carrier == Carrier::kPerson) AddGlances(plan.knots, kCarrierKnot_s, 1.2, motion);
  if (flies) AddGlances(plan.knots, kCarrierKnot_s, 2.6, motion);
  switch (carrier) {
    case Carrier::kPerson:
      return MountOnPerson(scenario, std::move(plan));
    case Carrier::kRobot:
      return MountOnRobot(scenario, std::move(plan));
    case Carrier::kDrone:
      return MountOnDrone(scenario, std::move(plan));
  }
}

}  // namespace lio::sim
