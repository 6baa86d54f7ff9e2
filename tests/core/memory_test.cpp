// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

TEST(Memory, LimitIsThatOfTheMachineTheEnvironmentOrTheProgram) {
  const double machine = memory_limit();
  EXPECT_GT(machine, 1e8);
  ::setenv("LINKWRIGHT_MEMORY_MB", "1500", 1);
  EXPECT_EQ(memory_limit(), 1.5e9);
  {
    const MemoryLimit here(1e6);
    EXPECT_EQ(memory_limit(), 1e6);
    const MemoryLimit inner(2e6);
    EXPECT_EQ(memory_limit(), 2e6);
  }
  EXPECT_EQ(memory_limit(), 1.5e9);
  for (const char* bad : {"", "much", "-3", "0", "12 MB"}) {
    ::setenv("LINKWRIGHT_MEMORY_MB", bad, 1);
    EXPECT_EQ(memory_limit(), machine) << bad;
  }
  ::unsetenv("LINKWRIGHT_MEMORY_MB");
  EXPECT_EQ(memory_limit(), machine);
  EXPECT_THROW(MemoryLimit(0), ContractError);
}

TEST(Memory, TellsWhatItWouldTake) {
  const MemoryLimit limit(2e9);
  EXPECT_FALSE(memory_problem(2e9, "a table"));
  EXPECT_EQ(memory_problem(2.43e11, "1000000000 nodes"),
            "1000000000 nodes would take 243 GB of memory, at most 2 GB may be taken");
  EXPECT_EQ(byte_text(12), "12 bytes");
  EXPECT_EQ(byte_text(12345), "12.3 kB");
  EXPECT_EQ(byte_text(6.4e8), "640 MB");
  EXPECT_EQ(byte_text(3e13), "30 TB");
  EXPECT_EQ(byte_text(7e18), "7e+03 PB");
}

}  // namespace
}  // namespace linkwright
