// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws random numbers that are a pure function of a key, so that worlds and measurements are the
// same on any number of threads and with any standard library. The mixing step is the finaliser of
// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace lio::sim {

[[nodiscard]] constexpr std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

[[nodiscard]] constexpr std::uint64_t HashKey(std::initializer_list<std::uint64_t> parts) {
  std::uint64_t key = 0;
  for (const std::uint64_t part : parts) key = MixBits(key ^ part);
  return key;
}

// Maps bits to a number uniform in (0, 1). It is never 0, so that its logarithm exists, and never 1
// (52 bits and a half are exact in a double; with 53 the last one would round up to 1).
[[nodiscard]] constexpr double UnitInterval(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1.0p-52;
}

// Names what a key's draws are used for, so that one purpose's numbers do not change with the
// number of another purpose's draws.
enum class Purpose : std::uint64_t {
  kWorld,
  kTraffic,
  kMotion,
  kImu,
  kLidar,
  kFault,
  kMount,
  kVibration,
  kLaser,
  kFootprint,
  kRotor,
  kClock,
  kEngine,
  kImuField
};

// Draws a sequence of numbers from one key. Each draw belongs in a statement of its own, or in
// braces: the order in which arguments and operands are evaluated is the compiler's.
class Random {
 public:
  Random(std::uint64_t seed, Purpose purpose, std::uint64_t stream = 0)
      : key_(HashKey({seed, static_cast<std::uint64_t>(purpose), stream})) {}

  [[nodiscard]] std::uint64_t Bits() { return MixBits(key_ ^ MixBits(counter_++)); }
  [[nodiscard]] double Uniform() { return UnitInterval(Bits()); }
  [[nodiscard]] double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  [[nodiscard]] int Integer(int low, int high) {  // both bounds are included
    return low + static_cast<int>(Uniform() * (high - low + 1));
  }
  [[nodiscard]] bool Chance(double probability) { return Uniform() < probability; }

  [[nodiscard]] double Gaussian() {  // Box and Muller's method; one of the pair is used
    const double radius = std::sqrt(-2.0 * std::log(Uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace lio::sim
