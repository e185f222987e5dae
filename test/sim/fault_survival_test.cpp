// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator on faulty logs: each fault of --fault must be counted and survived.
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "support/simulated_run.hpp"

namespace lio::sim {
namespace {

constexpr std::uint64_t kSeed = 5;

using Walk = test::SimulatedLog;

test::DriveSpec CampusWalk(const std::vector<Fault>& faults_of_the_world = {}) {
  return {"campus", "vlp16", 14.0, kSeed, faults_of_the_world};
}

// `driver_late`: chunks come so much later than they would.
test::RunOutcome Replay(const Walk& walk, const std::vector<std::string>& fault_texts,
                        Duration driver_late = {}) {
  std::vector<Fault> faults;
  for (const std::string& text : fault_texts) faults.push_back(ParseFault(text));
  const FaultInjector injector(faults, kSeed, walk.truth.front().stamp);
  ArrivalQueue queue;
  for (const Message& message : walk.messages) {
    for (Message& sent : injector.Apply(message)) {
      if (std::holds_alternative<ScanChunk>(sent.body)) sent.arrival = sent.arrival + driver_late;
      queue.Push(std::move(sent));
    }
  }
  Options options = walk.options;
  options.rig.T_imu_lidar = ClaimedExtrinsic(faults, *walk.options.rig.T_imu_lidar);
  test::RunningEstimator estimator(options);
  while (auto message = queue.PopBefore({INT64_MAX})) estimator.Take(std::move(*message));
  return estimator.Finish(walk.truth);
}

struct Expectation {
  const char* name;
  const char* fault;
  std::vector<std::int64_t Counters::*> counted;  // each must be above that of the clean walk
  double error_m;  // bound on the error at the end of about 10 m of walk
  double error_deg;
};

class FaultSurvival : public ::testing::TestWithParam<Expectation> {
 protected:
  static void SetUpTestSuite() {
    walk_ = new Walk(CampusWalk());
    clean_ = new test::RunOutcome(Replay(*walk_, {}));
  }
  static void TearDownTestSuite() {
    delete clean_;
    delete walk_;
  }
  static const Walk* walk_;
  static const test::RunOutcome* clean_;  // outcome without a fault
};
const Walk* FaultSurvival::walk_ = nullptr;
const test::RunOutcome* FaultSurvival::clean_ = nullptr;

TEST_P(FaultSurvival, IsCountedAndTheWalkGoesOn) {
  const Expectation& expected = GetParam();
  const test::RunOutcome outcome = Replay(*walk_, {expected.fault});
  for (const auto counter : expected.counted) {
    EXPECT_GT(outcome.counters.*counter, clean_->counters.*counter);
  }
  EXPECT_GT(outcome.num_rows, 90);
  EXPECT_LT(outcome.status, TrackingStatus::kLost);
  EXPECT_GE(outcome.status, TrackingStatus::kOk);
  EXPECT_LT(outcome.end_error_m, expected.error_m);
  EXPECT_LT(outcome.end_error_deg, expected.error_deg);
  RecordProperty("end_error_mm", static_cast<int>(1e3 * outcome.end_error_m));
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultSurvival,
    ::testing::Values(
        Expectation{"imu_gap", "imu_gap:start=7,duration=0.4", {&Counters::num_imu_gaps}, 0.3, 1},
        Expectation{
            "lidar_gap", "lidar_gap:start=7,duration=0.6", {&Counters::num_scan_gaps}, 0.3, 1},
        Expectation{"drop", "drop:ratio=0.1", {}, 0.3, 1},
        Expectation{"duplicate",
                    "duplicate:ratio=0.1",
                    {&Counters::num_imu_duplicate, &Counters::num_chunks_duplicate},
                    0.2,
                    1},
        Expectation{"reorder", "reorder:ratio=0.1,delay=0.03", {&Counters::num_imu_late}, 0.3, 1},
        Expectation{"chunk_loss", "chunk_loss:ratio=0.1", {&Counters::num_chunks_missing}, 0.3, 1},
        Expectation{"stamps_ahead",
                    "stamp_jump:start=7,offset=1.5,channel=lidar",
                    {&Counters::num_clock_jumps},
                    0.5,
                    2},
        Expectation{"stamps_back",
                    "stamp_jump:start=7,offset=-1.5,channel=lidar",
                    {&Counters::num_chunks_late},
                    0.5,
                    2},
        Expectation{"clock_offset", "clock_offset:offset=0.02", {&Counters::num_gated}, 0.5, 2},
        Expectation{"clock_a_sweep_behind", "clock_offset:offset=-0.1", {}, 0.5, 2},
        Expectation{"nan",
                    "nan:ratio=0.05",
                    {&Counters::num_imu_nonfinite, &Counters::num_points_nonfinite},
                    0.2,
                    1},
        Expectation{"gyro_saturation",
                    "gyro_saturation:start=6,duration=3,limit=0.3",
                    {&Counters::num_imu_clipped},
                    0.05,
                    1},
        Expectation{
            "empty_scan", "empty_scan:start=7,duration=0.5", {&Counters::num_scans_empty}, 0.3, 1},
        Expectation{"sparse_scan",
                    "sparse_scan:start=7,duration=0.5",
                    {&Counters::num_matches_rejected},
                    0.3,
                    1},
        Expectation{"wrong_extrinsic", "wrong_extrinsic:yaw_deg=1", {}, 0.5, 2}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(FaultSurvival, NothingIsCountedWithoutAFault) {
  const Counters& counters = clean_->counters;
  EXPECT_EQ(counters.num_imu_nonfinite + counters.num_imu_duplicate + counters.num_imu_late +
                counters.num_imu_gaps + counters.num_imu_out_of_range + counters.num_imu_clipped,
            0);
  EXPECT_EQ(counters.num_chunks_duplicate + counters.num_chunks_late + counters.num_chunks_missing +
                counters.num_chunks_bad + counters.num_points_nonfinite,
            0);
  EXPECT_EQ(counters.num_scans_empty + counters.num_scans_dropped + counters.num_scans_late +
                counters.num_scan_gaps + counters.num_clock_jumps + counters.num_restarts,
            0);
  EXPECT_EQ(clean_->status, TrackingStatus::kOk);
  EXPECT_LT(clean_->end_error_m, 0.2);
}

// Chunks that come late by their stamps are waited for.
TEST_F(FaultSurvival, ALidarWhoseClockIsASweepBehindLosesNoChunk) {
  const test::RunOutcome outcome = Replay(*walk_, {"clock_offset:offset=-0.1"});
  EXPECT_EQ(outcome.counters.num_chunks_late, 0);
  EXPECT_EQ(outcome.counters.num_chunks_missing, 0);
}

TEST_F(FaultSurvival, ADriverThatIsLateChangesNothing) {
  const test::RunOutcome outcome = Replay(*walk_, {}, Duration{150'000'000});
  EXPECT_EQ(outcome.counters.num_chunks_late, 0);
  EXPECT_EQ(outcome.end_error_m, clean_->end_error_m);
  EXPECT_EQ(outcome.end_error_deg, clean_->end_error_deg);
}

TEST_F(FaultSurvival, DustIsSeenThrough) {
  const Walk dusty(CampusWalk({ParseFault("dust:start=6,duration=4,density=0.05")}));
  const test::RunOutcome outcome = Replay(dusty, {});
  EXPECT_LE(outcome.status, TrackingStatus::kDegenerate);
  EXPECT_LT(outcome.end_error_m, 0.3);
}

}  // namespace
}  // namespace lio::sim
