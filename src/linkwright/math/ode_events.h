// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/math/ode_stepper.h"

namespace linkwright::math {

/// Finds the zero crossings of event functions within the steps of an integration. Part of ode.h, not for use
/// elsewhere.
class OdeEventFinder {
 public:
  /// Times are found to `tolerance`.
  void prepare(const OdeHooks& hooks, std::size_t n, double tolerance);

  /// Takes the sides of zero at the start or a restart, seen in the direction of integration. Functions that
  /// are zero, and those of `fired`, are on the side towards which y' moves them.
  void begin(double t, std::span<const double> y, std::span<const double> rate, double direction,
             std::span<const std::size_t> fired);

  /// The next crossings after `from` within the stepper's last step: time, or false. `which()` are those that
  /// the caller watches; none, when all cross the other way.
  bool find(OdeStepper& stepper, double from, double& t);
  std::span<const std::size_t> which() const { return which_; }

 private:
  static constexpr std::size_t parts = 8;

  void values_at(OdeStepper& stepper, double t, bool rough, std::span<double> values);
  void scan(OdeStepper& stepper, double from, bool rough);
  bool near_miss(std::size_t event, std::size_t part) const;
  bool suspicious() const;
  bool first_crossing(OdeStepper& stepper, std::size_t event, double from, double& t);
  bool dip(OdeStepper& stepper, std::size_t event, double& a, double& b);
  double locate(OdeStepper& stepper, std::size_t event, double a, double b);
  double value(OdeStepper& stepper, std::size_t event, double t);
  double at(std::size_t part, std::size_t event) const { return grid_[part * sides_.size() + event]; }

  const OdeHooks* hooks_ = nullptr;
  double tolerance_ = 0;
  double direction_ = 1;
  std::vector<double>
      quiet_;               // until when the values of an event count as on its side, whatever rounding says
  std::vector<int> sides_;  // sign of each event function, -1 or 1; 0: not known yet
  std::vector<double> grid_;  // values at the places compared, all events of one place together
  std::vector<double> values_, y_, times_;
  std::vector<std::size_t> which_;
};

}  // namespace linkwright::math
