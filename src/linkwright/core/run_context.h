// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"

namespace linkwright {

class Checkpoint;

/// A report of a long computation while it runs. Sent from any thread, but never by two threads at once.
struct Progress {
  std::string_view stage;  ///< current activity, for example "grey_wolf"
  double fraction = 0;     ///< done part of this stage, 0 to 1
  double best = nan;       ///< best cost so far, NaN if there is none
};

/// Progress, cancellation, deadline and checkpoint of one run; shared by reference, usable from any thread.
///
/// Algorithms call `interrupted()` at least once per generation or every millisecond or so of work and, when
/// it says so, return the best they have with that status.
class RunContext {
 public:
  /// Clock of the time limit.
  using Clock = std::chrono::steady_clock;

  /// A run without limit, progress and checkpoint, on all threads.
  RunContext() = default;
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  /// Asks the run to stop; safe in a signal handler and from any thread.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }

  /// Sets the time after which the run ends with the best so far; call before the run starts.
  /// @param limit time from now (s), >= 0; a year or more is no limit
  /// @throws ContractError if the limit is negative
  void set_time_limit(std::chrono::duration<double> limit);

  /// Ends with another run of which this one is a part: when that is cancelled or out of time, so is this
  /// one; call before the run starts.
  /// @param whole the other run, which must outlive this one
  void set_part_of(const RunContext& whole) { whole_ = &whole; }

  /// Receives progress; call before the run starts.
  /// @param report function that is called from any thread, but never by two at once; it must not throw
  void set_progress(std::function<void(const Progress&)> report) { report_ = std::move(report); }

  /// Sets how many threads the run may use. Results do not depend on it.
  /// @param threads number of threads, 0 = all
  void set_threads(int threads) { threads_ = threads; }
  /// @returns number of threads that the run may use, 0 = all
  int threads() const { return threads_; }

  /// Sets where the run saves its finished parts, and where it finds those of an earlier run; call before the
  /// run starts.
  /// @param checkpoint store that outlives the run; nullptr = nowhere, the default
  void set_checkpoint(Checkpoint* checkpoint) { checkpoint_ = checkpoint; }
  /// @returns the store of finished parts; nullptr = nowhere
  Checkpoint* checkpoint() const { return checkpoint_; }

  /// @returns `done` to continue, else `cancelled` or `deadline`
  Status interruption() const;
  /// @returns true if the run is to end
  bool interrupted() const { return interruption() != Status::done; }

  /// Passes progress on to the function of set_progress, or drops it while another thread reports.
  /// @param progress the present state of the run
  void report(const Progress& progress) const;

 private:
  std::atomic<bool> cancelled_{false};
  mutable std::atomic_flag reporting_ = ATOMIC_FLAG_INIT;
  Clock::time_point deadline_ = Clock::time_point::max();
  std::function<void(const Progress&)> report_;
  int threads_ = 0;
  Checkpoint* checkpoint_ = nullptr;
  const RunContext* whole_ = nullptr;
};

}  // namespace linkwright
