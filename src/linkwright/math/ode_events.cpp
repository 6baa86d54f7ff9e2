// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/ode_events.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/minimum.h"

namespace linkwright::math {
namespace {

// After a crossing, and from a start on zero, signs count again when this many tolerances have passed: far
// enough to outweigh what the tolerance leaves of the value, and no farther.
constexpr double settled_tolerances = 100;

constexpr double none = nan;

int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

void OdeEventFinder::prepare(const OdeHooks& hooks, std::size_t n, double tolerance) {
  hooks_ = &hooks;
  tolerance_ = tolerance;
  const std::size_t count = hooks.events.size();
  sides_.assign(count, 0);
  grid_.resize((parts + 1) * count);
  values_.resize(count);
  times_.resize(count);
  quiet_.resize(count);
  y_.resize(n);
  which_.clear();
  which_.reserve(count);
}

void OdeEventFinder::begin(double t, std::span<const double> y, std::span<const double> rate,
                           double direction, std::span<const std::size_t> fired) {
  if (sides_.empty()) return;
  direction_ = direction;
  const std::span<double> here = std::span(grid_).first(sides_.size());
  hooks_->event_values(t, y, here);
  const double ahead = direction * settled_tolerances * tolerance_;
  for (std::size_t j = 0; j < y.size(); ++j) y_[j] = y[j] + ahead * rate[j];
  hooks_->event_values(t + ahead, y_, values_);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    sides_[i] = sign(here[i]);
    quiet_[i] = t;
    const bool has_fired = std::find(fired.begin(), fired.end(), i) != fired.end();
    const bool zero = settled_tolerances * std::abs(here[i]) <= std::abs(values_[i] - here[i]);
    if (!has_fired && !zero) continue;
    sides_[i] = sign(values_[i]);
    quiet_[i] = t + ahead;
  }
}

void OdeEventFinder::values_at(OdeStepper& stepper, double t, bool rough, std::span<double> values) {
  if (rough)
    stepper.rough_state(t, y_);
  else
    stepper.state(t, y_);
  hooks_->event_values(t, y_, values);
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (direction_ * (t - quiet_[i]) < 0) values[i] = std::copysign(values[i], sides_[i]);
}

double OdeEventFinder::value(OdeStepper& stepper, std::size_t event, double t) {
  values_at(stepper, t, false, values_);
  return values_[event];
}

void OdeEventFinder::scan(OdeStepper& stepper, double from, bool rough) {
  const std::size_t count = sides_.size();
  for (std::size_t k = 1; k <= parts; ++k) {
    const double x = static_cast<double>(k) / parts;
    const double t = k == parts ? stepper.t1 : from + x * (stepper.t1 - from);
    values_at(stepper, t, rough, std::span(grid_).subspan(k * count, count));
  }
}

// True if a value that has a minimum here comes near enough to zero to look closer.
bool OdeEventFinder::near_miss(std::size_t event, std::size_t part) const {
  const double side = sides_[event], here = side * at(part, event);
  if (!(here > 0)) return false;
  if (part > 0 && side * at(part - 1, event) < here) return false;
  if (part < parts && side * at(part + 1, event) < here) return false;
  double lowest = here, highest = here;
  for (std::size_t k = 0; k <= parts; ++k) {
    lowest = std::min(lowest, side * at(k, event));
    highest = std::max(highest, side * at(k, event));
  }
  return here < 0.1 * (highest - lowest);
}

bool OdeEventFinder::suspicious() const {
  for (std::size_t i = 0; i < sides_.size(); ++i)
    for (std::size_t k = 0; k <= parts; ++k) {
      if (k > 0 && sign(at(k, i)) != sides_[i]) return true;
      if (near_miss(i, k)) return true;
    }
  return false;
}

// True if a point in [a, b] lies beyond zero; b is moved there.
bool OdeEventFinder::dip(OdeStepper& stepper, std::size_t event, double& a, double& b) {
  GoldenSection section{[&](double t) { return sides_[event] * value(stepper, event, t); }, a, b};
  for (int i = 0; i < 40 && std::abs(section.high - section.low) > tolerance_; ++i, section.narrow())
    if (section.at_left <= 0 || section.at_right <= 0) {
      b = section.at_left <= 0 ? section.left : section.right;
      return true;
    }
  return false;
}

// [a, b] holds a crossing: on the known side at a (whatever rounding says there), beyond it at b. Illinois'
// form of regula falsi, with a bisection after two steps that did not halve the bracket.
double OdeEventFinder::locate(OdeStepper& stepper, std::size_t event, double a, double b) {
  const double side = sides_[event];
  double at_a = side * value(stepper, event, a), at_b = side * value(stepper, event, b);
  int stuck = 0;
  while (std::abs(b - a) > tolerance_) {
    const double width = b - a, margin = std::copysign(0.5 * tolerance_, width);
    double m = a + 0.5 * width;
    if (stuck < 2 && at_a > 0 && at_b < 0) {
      m = a + width * (at_a / (at_a - at_b));
      const double low = a + margin, high = b - margin;
      m = width > 0 ? std::clamp(m, std::min(low, high), std::max(low, high))
                    : std::clamp(m, std::min(high, low), std::max(high, low));
    }
    if (m == a || m == b) break;
    const double at_m = side * value(stepper, event, m);
    if (at_m > 0) {
      a = m;
      at_a = at_m;
      at_b /= 2;
    } else {
      b = m;
      at_b = at_m;
      at_a /= 2;
    }
    stuck = std::abs(b - a) > 0.5 * std::abs(width) ? stuck + 1 : 0;
  }
  return b;
}

bool OdeEventFinder::first_crossing(OdeStepper& stepper, std::size_t event, double from, double& t) {
  const double step = stepper.t1 - from;
  const auto time = [&](std::size_t k) {
    return k == parts ? stepper.t1 : from + static_cast<double>(k) / parts * step;
  };
  for (std::size_t k = 0; k <= parts; ++k) {
    const int here = sign(at(k, event));
    if (sides_[event] == 0) {
      if (k > 0) sides_[event] = here;
      continue;
    }
    if (k > 0 && here != sides_[event]) {
      t = locate(stepper, event, time(k - 1), time(k));
      return true;
    }
    if (!near_miss(event, k)) continue;
    double a = time(k == 0 ? 0 : k - 1), b = time(std::min(k + 1, parts));
    if (dip(stepper, event, a, b)) {
      t = locate(stepper, event, a, b);
      return true;
    }
  }
  return false;
}

bool OdeEventFinder::find(OdeStepper& stepper, double from, double& t) {
  which_.clear();
  const std::size_t count = sides_.size();
  if (count == 0 || from == stepper.t1) return false;
  const auto ended = [&] {  // the end of this step is the start of the next
    std::copy_n(grid_.end() - static_cast<std::ptrdiff_t>(count), count, grid_.begin());
    return false;
  };
  scan(stepper, from, true);
  if (!suspicious()) return ended();
  scan(stepper, from, false);

  const double direction = stepper.t1 < from ? -1 : 1;
  double first = none;
  for (std::size_t i = 0; i < count; ++i) {
    times_[i] = none;
    double found = none;
    if (!first_crossing(stepper, i, from, found)) continue;
    times_[i] = found;
    if (!(direction * (found - first) >= 0)) first = found;
  }
  if (std::isnan(first)) return ended();

  // Events within the tolerance of the first happen together, when the last of them has crossed.
  t = first;
  for (const double found : times_)
    if (direction * (found - first) <= tolerance_ && direction * (found - t) > 0) t = found;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(direction * (times_[i] - t) <= 0)) continue;
    const OdeCrossing watched = hooks_->events[i].crossing;
    if (watched == OdeCrossing::either || (watched == OdeCrossing::rising) == (sides_[i] < 0))
      which_.push_back(i);
    sides_[i] = -sides_[i];
    quiet_[i] = t + direction * settled_tolerances * tolerance_;
  }
  values_at(stepper, t, false, std::span(grid_).first(count));
  return true;
}

}  // namespace linkwright::math
