// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sweeps are moved by the clock offset that matched ones show.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/stream/sensor_stream.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::ImuAt;
using test::OnlyImu;
using test::SensorMessage;
using test::Sensors;
using test::StampAt;
using test::StreamRun;
using test::SweepFrom;

TEST(SensorStream, SweepThatIsMovedWaitsUntilInertialSamplesPassItsMovedEnd) {
  for (const double by_s : {0.03, -0.03}) {
    StreamOptions options;
    options.max_unmatched = 1;
    StreamRun run(options);
    run.Feed(OnlyImu(-0.2, 0.0));
    run.Add(SweepFrom(-0.1));
    run.Add(ImuAt(0.0));
    while (run.SweepStarts().empty()) run.events.push_back(run.stream.Next(0).value());
    run.stream.SetStampCorrection(Duration::FromSeconds(by_s));
    run.Feed({SweepFrom(0.0)});
    run.Feed(OnlyImu(0.01, 0.09 + by_s));
    EXPECT_EQ(run.SweepStarts().size(), 1U);
    run.Feed({ImuAt(0.09 + by_s)});
    ASSERT_EQ(run.SweepStarts().size(), 2U);
    const SweepReady sweep = run.Of<SweepReady>().at(1);
    EXPECT_EQ(sweep.sweep->start, StampAt(by_s));
    EXPECT_EQ(sweep.sweep->end, StampAt(0.09 + by_s));
    EXPECT_EQ(sweep.sweep->clock_correction, Duration::FromSeconds(by_s));
    run.Feed({ImuAt(0.085 + by_s)});
    EXPECT_EQ(run.counters.num_imu_late, 1) << "nothing may change up to the moved end";
  }
}

TEST(SensorStream, SweepsAreMovedOnlyWhereThatIsAskedFor) {
  StreamRun run;
  run.stream.SetStampCorrection(Duration::FromSeconds(0.03));
  run.Feed(Sensors(0.0, 0.31));
  EXPECT_EQ(run.SweepStarts().at(1), StampAt(0.1));
}

// A slow matcher and a fast one learn the same offset after the same sweep. Both get sweeps of the
// same stamps.
TEST(SensorStream, CorrectionDoesNotDependOnHowFastSweepsAreMatched) {
  constexpr std::size_t kMaxUnmatched = 4;
  const auto starts_with = [kMaxUnmatched](std::size_t num_behind) {
    StreamOptions options;
    options.max_unmatched = kMaxUnmatched;
    StreamRun run(options);
    std::size_t num_sweeps = 0;
    std::size_t num_matched = 0;
    const auto drain = [&] {
      while (auto event = run.stream.Next(num_sweeps - num_matched)) {
        num_sweeps += std::holds_alternative<SweepReady>(*event) ? 1 : 0;
        run.events.push_back(std::move(*event));
      }
    };
    for (const SensorMessage& message : Sensors(0.0, 3.0)) {
      run.Add(message);
      drain();
      while (num_matched + num_behind < num_sweeps) {
        run.stream.SetStampCorrection(Duration{1'000'000 * static_cast<int>(++num_matched)});
        drain();
      }
    }
    return run.SweepStarts();
  };
  const std::vector<Timestamp> fast = starts_with(0);
  ASSERT_GT(fast.size(), 20U);
  EXPECT_EQ(fast.at(3), StampAt(0.3)) << "none of its predecessors needs to be matched";
  EXPECT_EQ(fast.at(4), StampAt(0.401)) << "the first one is";
  EXPECT_EQ(fast.at(10), StampAt(1.007));
  for (const std::size_t num_behind : {1, 3}) {
    const std::vector<Timestamp> slow = starts_with(num_behind);
    ASSERT_GE(slow.size(), fast.size() - kMaxUnmatched);
    EXPECT_TRUE(std::equal(slow.begin(), slow.end(), fast.begin())) << num_behind;
  }
}

TEST(SensorStream, WaitsWhileTooManySweepsAreUnmatched) {
  StreamOptions options;
  options.max_unmatched = 2;
  StreamRun run(options);
  for (const SensorMessage& message : Sensors(0.0, 1.0)) run.Add(message);
  while (auto event = run.stream.Next(run.SweepStarts().size())) run.events.push_back(*event);
  EXPECT_EQ(run.SweepStarts().size(), 2U);
  run.Drain();
  EXPECT_EQ(run.SweepStarts().size(), 9U);
}

}  // namespace
}  // namespace lio
