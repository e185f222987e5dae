// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/output_worker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <stdexcept>
#include <thread>

#include "app/no_fault.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::ExpectNoFault;

class OutputWorkerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const std::string& channel : {channels_.status, channels_.cloud, channels_.cloud_full}) {
      bus_->Subscribe(channel, 100, [this, channel](ByteView data, std::int64_t) {
        received_.push_back(channel);
        sizes_.push_back(data.size());
      });
    }
  }
  std::ptrdiff_t NumReceived(const std::string& channel) {
    while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
    }
    return std::count(received_.begin(), received_.end(), channel);
  }

  Channels channels_;
  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
  Publisher publisher_{*bus_, channels_};
  std::vector<std::string> received_;
  std::vector<std::size_t> sizes_;
};

NavOutput ImuRate(std::int64_t stamp_ns) {
  NavOutput nav;
  nav.stamp = Timestamp{stamp_ns};
  nav.source = OdometrySource::kImuPropagated;
  return nav;
}

TEST_F(OutputWorkerTest, RowsThatWaitAreWrittenBeforeItEnds) {
  const test::TempDir folder;
  RunWriter writer(folder.path(), Options{});
  {
    OutputWorker worker(
        publisher_, &writer, "1.0.0", [] { return StatusReport{}; }, ExpectNoFault);
    for (int i = 1; i <= 1000; ++i) worker.PutRow(ImuRate(i));
  }
  writer.Finish({});
  const std::string text = test::ReadText(folder.path() / "trajectory_imu_rate.tum");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1000);
}

TEST_F(OutputWorkerTest, WithoutFilesRowsAreIgnored) {
  OutputWorker worker(
      publisher_, nullptr, "1.0.0", [] { return StatusReport{}; }, ExpectNoFault);
  worker.PutRow(ImuRate(1));
  worker.Finish();
  EXPECT_EQ(worker.num_rows_dropped(), 0);
}

TEST_F(OutputWorkerTest, StatusIsSentAtTheStartWhenAnnouncedAndAtTheEnd) {
  OutputWorker worker(
      publisher_, nullptr, "1.0.0", [] { return StatusReport{}; }, ExpectNoFault);
  while (NumReceived(channels_.status) < 1) std::this_thread::yield();
  worker.AnnounceStatus();
  while (NumReceived(channels_.status) < 2) std::this_thread::yield();
  worker.Finish();
  EXPECT_EQ(NumReceived(channels_.status), 3);
}

TEST_F(OutputWorkerTest, CloudsAreSentFullOnesInChunksOfOneDatagram) {
  OutputWorker worker(
      publisher_, nullptr, "1.0.0", [] { return StatusReport{}; }, ExpectNoFault);
  worker.Put(RegisteredCloud{Timestamp{1}, 0, std::vector<Eigen::Vector3f>(10)});
  auto sweep = std::make_shared<Sweep>();
  sweep->end = Timestamp{100'000'000};
  sweep->points.resize(kMaxChunkPoints + 1);
  worker.Put(FullCloudTask{sweep, {{sweep->start, {}}, {sweep->end, {}}}, {}, {}});
  worker.Finish();
  EXPECT_EQ(NumReceived(channels_.cloud), 1);
  EXPECT_EQ(NumReceived(channels_.cloud_full), 2);
  EXPECT_LE(*std::max_element(sizes_.begin(), sizes_.end()), 65'499u);  // LCM's datagram
}

TEST_F(OutputWorkerTest, AfterAFaultTheRowsAreKeptAndCanBeWritten) {
  const test::TempDir folder;
  RunWriter writer(folder.path(), Options{});
  std::promise<std::string> reported;
  OutputWorker worker(
      publisher_, &writer, "1.0.0", []() -> StatusReport { throw std::runtime_error("no status"); },
      [&](const std::string& fault) { reported.set_value(fault); });
  EXPECT_EQ(reported.get_future().get(), "the output thread failed: no status");
  for (int i = 1; i <= 10; ++i) worker.PutRow(ImuRate(i));
  worker.Finish();
  worker.WriteRowsLeft();
  writer.Finish({});
  const std::string text = test::ReadText(folder.path() / "trajectory_imu_rate.tum");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
}

}  // namespace
}  // namespace lio
