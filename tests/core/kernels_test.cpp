// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/kernels.h"

#include <gmock/gmock.h>

namespace linkwright {
namespace {

using Kernel = int();
int plain() { return 1; }
int wide() { return 2; }
int widest_of_all() { return 3; }

TEST(KernelSet, GivesWhatTheProcessorHasNarrowestFirst) {
  const auto all = runnable(KernelSet<Kernel>{plain, wide, widest_of_all});
  ASSERT_EQ(all.size(), 1u + has_avx2() + has_avx512());
  EXPECT_EQ(all[0].run(), 1);
  EXPECT_STREQ(all[0].name, "baseline");
  const NamedKernel<Kernel> best = widest(KernelSet<Kernel>{plain, wide, widest_of_all});
  EXPECT_EQ(best.run, all.back().run);
  EXPECT_STREQ(best.name, has_avx512() ? "avx512" : has_avx2() ? "avx2" : "baseline");
}

TEST(KernelSet, LeavesOutWhatWasNotCompiled) {
  const auto all = runnable(KernelSet<Kernel>{plain});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(widest(KernelSet<Kernel>{plain}).run(), 1);
}

}  // namespace
}  // namespace linkwright
