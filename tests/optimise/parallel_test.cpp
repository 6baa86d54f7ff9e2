// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "support/message.h"

namespace linkwright::optimise {
namespace {

TEST(Parallel, CallsEachIndexOnce) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(1000, threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& c : calls) EXPECT_EQ(c, 1);
  }
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

TEST(Parallel, OneThreadIsThisThreadInOrder) {
  std::vector<std::size_t> order;
  const auto self = std::this_thread::get_id();
  parallel_for(10, 1, [&](std::size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), self);
    order.push_back(i);
  });
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(Parallel, NestedLoopsFinish) {
  std::atomic<int> sum{0};
  parallel_for(8, 3,
               [&](std::size_t) { parallel_for(8, 2, [&](std::size_t i) { sum += static_cast<int>(i); }); });
  EXPECT_EQ(sum, 8 * 28);
}

TEST(Parallel, NegativeThreadsAreAnError) {
  EXPECT_THAT(linkwright::test::message([] { parallel_for(3, -1, [](std::size_t) {}); }),
              ::testing::HasSubstr("number of threads must not be negative, got -1"));
}

}  // namespace
}  // namespace linkwright::optimise
