// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/machine.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <thread>
#include <vector>

namespace linkwright::platform {
namespace {

TEST(Machine, SaysWhatItHas) {
  EXPECT_GT(memory(), 1e8);
  EXPECT_FALSE(host_name().empty());
  EXPECT_GE(own_processors(), 1);
  EXPECT_LE(own_processors(), std::max(processors(), static_cast<int>(std::thread::hardware_concurrency())));
}

TEST(Machine, CountsTheProcessorsThatAProcessIsLeft) {
  std::thread bound([] {  // the processors that a thread may use are its own
    cpu_set_t all, first;
    ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&first);
    for (std::size_t i = 0; CPU_COUNT(&first) == 0; ++i)
      if (CPU_ISSET(i, &all)) CPU_SET(i, &first);
    ASSERT_EQ(::sched_setaffinity(0, sizeof first, &first), 0);
    EXPECT_EQ(own_processors(), 1);
  });
  bound.join();
}

TEST(Machine, RandomNumbersDiffer) {
  std::array<unsigned char, 32> one{}, two{};
  fill_random(one);
  fill_random(two);
  EXPECT_NE(one, two);
  EXPECT_GT(std::count_if(one.begin(), one.end(), [](unsigned char byte) { return byte != 0; }), 16);
  std::vector<unsigned char> many(257);
  EXPECT_THROW(fill_random(many), std::system_error);
}

TEST(Machine, MemoryIsNoMoreThanTheProcessMayTake) {
  const double all = memory();
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  rlimit less = before;
  less.rlim_cur = 123'456'789;
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &less), 0);
  const double allowed = memory();
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(allowed, 123'456'789);
  EXPECT_EQ(memory(), all);
}

}  // namespace
}  // namespace linkwright::platform
