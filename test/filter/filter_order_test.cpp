// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests that the filter's result does not depend on the order in which events arrive.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "filter/tumbling_filter.hpp"
#include "support/property.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::Difference;
using test::kTumbleStep_s;
using test::PoseAt;
using test::SampleAt;
using test::StampAt;
using test::StartedHistory;

constexpr double kStandstillVar = 4.0;  // (m/s)^2: the tumbling body never rests

enum class Kind { kImu, kPose, kStandstill, kRebase };
struct Event {
  Kind kind = Kind::kImu;
  double t_s = 0;
  PoseEvent pose;  // for poses
};

EventOutcome Feed(FilterHistory& history, const Event& event) {
  switch (event.kind) {
    case Kind::kImu:
      return history.AddImu(SampleAt(event.t_s));
    case Kind::kPose:
      return history.AddPose(StampAt(event.t_s), event.pose);
    case Kind::kStandstill:
      return history.AddZeroVelocity(StampAt(event.t_s), kStandstillVar);
    case Kind::kRebase:
      break;
  }
  return history.AddRebase(StampAt(event.t_s));
}

// Returns, in order, a second and a half of samples, some of them lost, and poses, one in eight far
// off, with standstills and rebases among them, at stamps of their own or at a sample's.
std::vector<Event> RandomEvents() {
  std::vector<Event> events;
  for (int i = 1; i <= 75; ++i) {
    const bool is_lost = *rc::gen::inRange(0, 10) == 9;
    if (!is_lost) events.push_back({Kind::kImu, i * kTumbleStep_s, {}});
  }
  const auto pose_stamps_ms = *rc::gen::unique<std::vector<int>>(rc::gen::inRange(1, 1501));
  for (const int stamp_ms : pose_stamps_ms) {
    const double t_s = 1e-3 * stamp_ms;
    std::mt19937_64 random(static_cast<unsigned>(stamp_ms));
    const double size = *rc::gen::inRange(0, 8) == 0 ? 2.0 : 0.01;
    PoseEvent event = PoseAt(t_s, size * test::RandomVector<6>(random));
    event.force = *rc::gen::arbitrary<bool>();
    event.measurement.new_content_share = 0.1;
    event.measurement.blend_cov = 1e-4 * Matrix6::Identity();
    events.push_back({Kind::kPose, t_s, event});
    if (*rc::gen::inRange(0, 4) == 0) events.push_back({Kind::kStandstill, t_s, {}});
    if (*rc::gen::inRange(0, 6) == 0) events.push_back({Kind::kRebase, t_s, {}});
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return StampAt(a.t_s) != StampAt(b.t_s) ? a.t_s < b.t_s : a.kind < b.kind;
  });
  return events;
}

// Returns the same events in the order of arrival when each is delayed by up to a second.
std::vector<Event> Delayed(const std::vector<Event>& events) {
  const std::vector<int> delays_ms =
      *rc::gen::container<std::vector<int>>(events.size(), rc::gen::inRange(0, 1001));
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return events[a].t_s + 1e-3 * delays_ms[a] < events[b].t_s + 1e-3 * delays_ms[b];
  });
  std::vector<Event> delayed;
  for (const std::size_t i : order) delayed.push_back(events[i]);
  return delayed;
}

TEST(FilterHistory, AnyOrderOfArrivalGivesThePosteriorOfTheRightOne) {
  test::CheckProperty([] {
    const std::vector<Event> events = RandomEvents();
    FilterHistory in_order = StartedHistory();
    for (const Event& event : events) Feed(in_order, event);
    FilterHistory as_arrived = StartedHistory();
    for (const Event& event : Delayed(events)) Feed(as_arrived, event);
    RC_ASSERT(as_arrived.head().stamp == in_order.head().stamp);
    RC_ASSERT(Difference(as_arrived.head(), in_order.head()) < 1e-9);
    const Timestamp between = StampAt(1e-3 * *rc::gen::inRange(0, 1600));
    RC_ASSERT(Difference(as_arrived.At(between), in_order.At(between)) < 1e-9);
  });
}

}  // namespace
}  // namespace lio
