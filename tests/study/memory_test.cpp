// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/core/memory.h"
#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

TEST(StudyMemory, SaysAtTheKeyWhatIsTooMuch) {
  const MemoryLimit limit(2e9);
  Diagnostics problems;
  const Value value = read_text("[sweep]\nsamples = 5000\n", Syntax::toml, "s.toml", problems);
  DocumentReader document(value, "s.toml", problems);
  ObjectReader table = *document.root().table("sweep");
  int samples = 0;
  table(field::entry("samples"), samples);
  EXPECT_TRUE(require_memory(table, "samples", 2e9, "5000 rows", "take fewer samples"));
  EXPECT_FALSE(require_memory(table, "samples", 3e12, "5000 rows", "take fewer samples"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(to_string(problems[0]),
            "s.toml:2:11: error: sweep.samples: 5000 rows would take 3 TB of memory, at most 2 GB may be "
            "taken; take "
            "fewer samples, or allow more with the environment variable LINKWRIGHT_MEMORY_MB");
  EXPECT_EQ(table_bytes(1e5, 44), 5.72e8);
  EXPECT_EQ(population_bytes(1e6, 10), 2.304e9);
}

}  // namespace
}  // namespace linkwright::study
