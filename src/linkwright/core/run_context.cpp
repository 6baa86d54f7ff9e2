// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/run_context.h"

#include "linkwright/core/check.h"
#include "linkwright/core/looks.h"

namespace linkwright {

static_assert(std::atomic<bool>::is_always_lock_free, "cancel() is called from signal handlers");

void RunContext::set_time_limit(std::chrono::duration<double> limit) {
  LINKWRIGHT_REQUIRE(limit.count() >= 0, "time limit must not be negative, got {} s", limit.count());
  constexpr double longest = 3600.0 * 24 * 365;  // keeps the conversion to clock ticks in range
  if (limit.count() < longest) deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

Status RunContext::interruption() const {
  if (cancelled_.load(std::memory_order_relaxed)) return Status::cancelled;
  const bool late = deadline_ != Clock::time_point::max() && Clock::now() >= deadline_;
  if (whole_ && !late) return whole_->interruption();
  return counted_look(late ? Status::deadline : Status::done);
}

void RunContext::report(const Progress& progress) const {
  if (!report_ || reporting_.test_and_set(std::memory_order_acquire)) return;  // another thread is reporting
  report_(progress);
  reporting_.clear(std::memory_order_release);
}

}  // namespace linkwright
