// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/check.h"
#include "linkwright/optimise/parallel.h"

// For places that have one thread, such as a page of a browser: what is run is the same, in the order of the
// numbers.
namespace linkwright::optimise {

void parallel_for(std::size_t count, int threads, math::FunctionRef<void(std::size_t)> body) {
  LINKWRIGHT_REQUIRE(threads >= 0, "number of threads must not be negative, got {}", threads);
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace linkwright::optimise
