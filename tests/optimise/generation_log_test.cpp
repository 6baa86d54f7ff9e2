// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/detail/generation_log.h"

#include <gmock/gmock.h>

namespace linkwright::optimise {
namespace {

TEST(GenerationLog, HoldsEveryGenerationOfAUsualRun) {
  EXPECT_EQ(log_interval(1), 1);
  EXPECT_EQ(log_interval(max_logged), 1);
  EXPECT_EQ(log_interval(max_logged + 1), 1 + 1);
  EXPECT_EQ(log_interval(2 * max_logged + 1), 2);
  EXPECT_EQ(log_interval(2 * max_logged + 2), 4);
  EXPECT_EQ(log_interval(1'000'000'000), 1 << 14);
}

TEST(GenerationLog, HoldsWhatItsIntervalDivides) {
  std::vector<int> log;
  int times = 0;
  for (int generation = 1; generation <= 5 * max_logged; ++generation) {
    times += log_generation(log, generation, [&] { return generation; });
    ASSERT_LE(log.size(), static_cast<std::size_t>(max_logged));
    const int interval = log_interval(generation);
    ASSERT_EQ(log.size(), static_cast<std::size_t>(generation / interval)) << generation;
    ASSERT_EQ(log.back(), generation - generation % interval) << generation;
    ASSERT_EQ(log.front(), interval) << generation;
  }
  EXPECT_EQ(times, 3);
  for (std::size_t k = 0; k < log.size(); ++k) ASSERT_EQ(log[k], 8 * static_cast<int>(k + 1));
}

}  // namespace
}  // namespace linkwright::optimise
