// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/relief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lio/sim/random.hpp"
#include "spread.hpp"

namespace lio::sim {
namespace {

const MaterialTraits& Soil() {
  return TraitsOf(Material::kSoil);
}

struct FirstHit {
  Ray ray;
  Hit hit;
};

// A beam from 1 m above level soil that comes down at this sine, somewhere.
FirstHit BeamDown(double sine, Random& random) {
  FirstHit beam;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double heading = random.Uniform(0.0, 6.28);
  beam.ray.origin_m = Vector3{random.Uniform(-50, 50), random.Uniform(-50, 50), 1.0}.cast<float>();
  beam.ray.direction =
      Vector3(cosine * std::cos(heading), cosine * std::sin(heading), -sine).cast<float>();
  beam.hit = {static_cast<float>(1.0 / sine), static_cast<float>(sine), Material::kSoil,
              Hit::kFixed, Vector3f::UnitZ()};
  return beam;
}

Vector3 PointAt(const Ray& ray, double range_m) {
  return ray.origin_m.cast<double>() + range_m * ray.direction.cast<double>();
}

test::Spread SpreadOf(const std::vector<double>& values) {
  const double num = static_cast<double>(values.size());
  test::Spread spread;
  for (const double value : values) spread.mean += value / num;
  for (const double value : values) spread.std += std::pow(value - spread.mean, 2) / num;
  spread.std = std::sqrt(spread.std);
  return spread;
}

// Heights above the mesh at which beams of this sine end.
std::vector<double> HeightsSeen(double sine) {
  Random random(1, Purpose::kWorld);
  std::vector<double> heights_m;
  for (int i = 0; i < 2000; ++i) {
    const FirstHit beam = BeamDown(sine, random);
    heights_m.push_back(PointAt(beam.ray, double{RangeOnRelief(beam.ray, beam.hit)}).z());
  }
  return heights_m;
}

TEST(Relief, IsSmoothNoiseAboutTheMeshWithinItsHeight) {
  Random random(1, Purpose::kWorld);
  std::vector<double> heights_m;
  double steepest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = {random.Uniform(-90, 90), random.Uniform(-90, 90), random.Uniform(-9, 9)};
    const double height_m = ReliefAt(Soil(), p);
    const double beside_m = ReliefAt(Soil(), p + 1e-3 * Vector3::UnitX());
    steepest = std::max(steepest, std::abs(beside_m - height_m) / 1e-3);
    heights_m.push_back(height_m);
    ASSERT_LE(std::abs(height_m), Soil().relief_m);
  }
  EXPECT_NEAR(SpreadOf(heights_m).mean, 0.0, 0.001);
  EXPECT_NEAR(SpreadOf(heights_m).std, 0.017, 0.003);
  EXPECT_GT(steepest, 0.3) << "clods have sides";
  EXPECT_LT(steepest, 1.5) << "the march along a ray relies on it";
}

TEST(Relief, ABeamEndsOnTheFirstThingThatStandsOut) {
  Random random(2, Purpose::kWorld);
  for (int i = 0; i < 50; ++i) {
    const FirstHit beam = BeamDown(0.1, random);
    const double end_m = RangeOnRelief(beam.ray, beam.hit);
    EXPECT_NEAR(PointAt(beam.ray, end_m).z(), ReliefAt(Soil(), PointAt(beam.ray, end_m)), 0.008);
    for (double range_m = end_m - 1.0; range_m < end_m - 0.01; range_m += 0.002) {
      const Vector3 p = PointAt(beam.ray, range_m);
      ASSERT_GT(p.z(), ReliefAt(Soil(), p) - 0.004) << "at " << range_m << " of " << end_m;
    }
  }
}

TEST(Relief, LooksHigherTheFlatterItIsSeen) {
  const double steep_m = SpreadOf(HeightsSeen(0.9)).mean;
  const double slanting_m = SpreadOf(HeightsSeen(0.3)).mean;
  const double flat_m = SpreadOf(HeightsSeen(0.1)).mean;
  EXPECT_NEAR(steep_m, 0.0, 0.003);
  EXPECT_GT(slanting_m, steep_m + 0.002);
  EXPECT_GT(flat_m, slanting_m + 0.004);
}

TEST(Relief, AsphaltHasNone) {
  Random random(3, Purpose::kWorld);
  FirstHit beam = BeamDown(0.2, random);
  beam.hit.material = Material::kAsphalt;
  EXPECT_EQ(RangeOnRelief(beam.ray, beam.hit), beam.hit.range_m);
}

}  // namespace
}  // namespace lio::sim
