// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace linkwright::clearance {

/// Follows the steps of an integration, and sees early that it cannot come to its end: when the steps so far,
/// carried on to the end, are many times those that it may take. Looked at after 20 000 steps and whenever
/// their number has doubled, so that a slow start does not count for much.
class StepPace {
 public:
  /// From one time to another (s) in `allowed` steps at most.
  StepPace(double from, double to, long allowed) : from_(from), to_(to), allowed_(allowed) {}

  /// After each step, which ended at `t`. False when it is hopeless.
  bool step(double t);
  /// Steps that it would take, as last looked at; 0 before.
  double expected() const { return expected_; }
  /// Says why it is hopeless: "ended at 0.001 s after 20000 steps: at this pace 0.4 s would take about 8e+06
  /// ...".
  std::string message(double t) const;

 private:
  double from_, to_;
  long allowed_, steps_ = 0, next_ = 20'000;
  double expected_ = 0;
};

}  // namespace linkwright::clearance
