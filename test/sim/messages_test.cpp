// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/messages.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

Message At(std::int64_t ns, int seq) {
  ImuMessage imu;
  imu.seq = seq;
  return {{ns}, imu};
}

TEST(ArrivalQueue, GivesByArrivalAndKeepsTheOrderOfEquals) {
  ArrivalQueue queue;
  queue.Push(At(30, 0));
  queue.Push(At(10, 1));
  queue.Push(At(20, 2));
  queue.Push(At(10, 3));
  std::vector<int> order;
  while (const auto message = queue.PopBefore({30})) {
    order.push_back(std::get<ImuMessage>(message->body).seq);
  }
  EXPECT_EQ(order, (std::vector<int>{1, 3, 2}));
  EXPECT_TRUE(queue.PopBefore({31}));
  EXPECT_FALSE(queue.PopBefore({1000}));
}

}  // namespace
}  // namespace lio::sim
