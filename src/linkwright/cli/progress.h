// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"

namespace linkwright::cli {

/// Elapsed and remaining time of a run (s).
struct Pace {
  double elapsed = 0;
  double left = nan;  ///< until the end of this stage; NaN = cannot be said yet
};

/// One line of progress of at most `width` characters: "grey_wolf  [#####.....]  50%  0:12, 0:12 left  best
/// 0.00903  Ctrl-C keeps the best". Where it does not fit, the bar goes first, then parts from the end.
std::string progress_line(const Progress& progress, const Pace& pace, std::size_t width);

/// The time left of a stage of which this fraction took so long (s); NaN before a second or a hundredth.
double time_left(double fraction, double seconds);

/// Shows the progress of a run on standard error while it lives; silent unless that is a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(RunContext& context, bool quiet = false);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  void show(const Progress& progress);

  RunContext& context_;
  bool active_;
  std::size_t shown_ = 0;
  Clock::time_point start_ = Clock::now(), stage_start_ = start_, next_{};
  std::string stage_;
};

}  // namespace linkwright::cli
