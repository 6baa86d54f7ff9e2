// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/optimise/parallel.h"

// For places where TBB is not: a thread sanitizer sees what these threads share, and nothing of what TBB's
// do.
namespace linkwright::optimise {

void parallel_for(std::size_t count, int threads, math::FunctionRef<void(std::size_t)> body) {
  LINKWRIGHT_REQUIRE(threads >= 0, "number of threads must not be negative, got {}", threads);
  const std::size_t available = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t workers =
      std::min({count, available, threads == 0 ? available : static_cast<std::size_t>(threads)});
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::mutex guard;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next.fetch_add(1)) < count;) body(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(guard);
      if (!thrown) thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t w = 1; w < workers; ++w) others.emplace_back(work);
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace linkwright::optimise
