// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/match_worker.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "app/no_fault.hpp"
#include "lio/io/cpu_clock.hpp"

namespace lio {
namespace {

using test::ExpectNoFault;

MatchJob EmptyJob(std::int32_t scan_seq) {
  auto sweep = std::make_shared<Sweep>();
  sweep->scan_seq = scan_seq;
  sweep->end = Timestamp{100'000'000};
  MatchJob job;
  job.T_any_imu = {{sweep->start, {}}, {sweep->end, {}}};
  job.sweep = std::move(sweep);
  return job;
}

InsertTask SomePoints() {
  return {.points_imu = {Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)},
          .T_map_imu = Pose::Identity()};
}

TEST(MatchWorker, JobsAndInsertionsAreDoneInOrderAndToTheEnd) {
  std::vector<std::int32_t> done;
  MatchWorker worker(
      Options{}, ThreadCpuNs, true, nullptr,
      [&](const MatchOutcome& outcome) { done.push_back(outcome.sweep->scan_seq); }, ExpectNoFault);
  for (int i = 0; i < 20; ++i) {
    worker.Tell(SomePoints());
    worker.Tell(EmptyJob(i));
  }
  worker.Finish();
  ASSERT_EQ(done.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
  EXPECT_GT(worker.map_bytes(), 0u);
  EXPECT_EQ(worker.map_cloud().points_map().size(), 2u);
}

TEST(MatchWorker, TheMapsPointsAreCollectedOnlyWhenAskedFor) {
  MatchWorker worker(
      Options{}, ThreadCpuNs, false, nullptr, [](const MatchOutcome&) {}, ExpectNoFault);
  worker.Tell(SomePoints());
  worker.Finish();
  EXPECT_TRUE(worker.map_cloud().points_map().empty());
}

TEST(MatchWorker, ANewMapForgetsTheOldOnesPoints) {
  MatchWorker worker(
      Options{}, ThreadCpuNs, true, nullptr, [](const MatchOutcome&) {}, ExpectNoFault);
  worker.Tell(SomePoints());
  MatchJob job = EmptyJob(1);
  job.map_action = MapAction::kClear;
  worker.Tell(std::move(job));
  worker.Finish();
  EXPECT_TRUE(worker.map_cloud().points_map().empty());
}

TEST(MatchWorker, AFaultIsReportedOnceAndEndsTheWork) {
  std::vector<std::string> faults;
  int num_delivered = 0;
  MatchWorker worker(
      Options{}, ThreadCpuNs, true, nullptr,
      [&](const MatchOutcome&) {
        ++num_delivered;
        throw std::runtime_error("nobody takes it");
      },
      [&](const std::string& fault) { faults.push_back(fault); });
  worker.Tell(EmptyJob(1));
  worker.Tell(EmptyJob(2));
  worker.Finish();
  EXPECT_EQ(faults, std::vector<std::string>{"the match thread failed: nobody takes it"});
  EXPECT_EQ(num_delivered, 1);
}

}  // namespace
}  // namespace lio
