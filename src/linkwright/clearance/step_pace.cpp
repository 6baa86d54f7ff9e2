// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/step_pace.h"

#include <fmt/core.h>

namespace linkwright::clearance {
namespace {

// A motion can become that much quicker to follow, as when vibrations of the start die out.
constexpr double many_times = 20;

}  // namespace

bool StepPace::step(double t) {
  if (++steps_ < next_) return true;
  next_ *= 2;
  const double share = (t - from_) / (to_ - from_);
  expected_ = static_cast<double>(steps_) / share;
  return !(expected_ > many_times * static_cast<double>(allowed_));
}

std::string StepPace::message(double t) const {
  return fmt::format(
      "ended at {:.6g} s after {} steps: at this pace {:.6g} s would take about {:.2g} steps, and max_steps "
      "allows {}; a shorter time, a larger clearance, a softer contact or a coarser rtol needs fewer",
      t, steps_, to_, expected_, allowed_);
}

}  // namespace linkwright::clearance
