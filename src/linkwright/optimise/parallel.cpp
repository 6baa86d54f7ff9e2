// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "linkwright/core/check.h"

namespace linkwright::optimise {

void parallel_for(std::size_t count, int threads, math::FunctionRef<void(std::size_t)> body) {
  LINKWRIGHT_REQUIRE(threads >= 0, "number of threads must not be negative, got {}", threads);
  if (threads == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // An arena of its own bounds the threads, and keeps a waiting thread from taking up work of an outer loop.
  // More threads than processors would not be given, and complained about on stderr.
  const int available = tbb::info::default_concurrency();
  tbb::task_arena arena(threads == 0 ? available : std::min(threads, available));
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner());
  });
}

}  // namespace linkwright::optimise
