// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/geneva.h"

#include <array>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {
namespace {

/// The crank angle from the middle of the last passage, and the passages before that.
struct Passage {
  double from_middle = 0, before = 0;
};
Passage passage_at(double crank) {
  const double before = std::round(crank / full_turn);
  return {crank - before * full_turn, before};
}
double entry(const GenevaSlots& slots) { return pi / 2 + (slots.internal ? pi : -pi) / slots.count; }

}  // namespace

double geneva_crank(const GenevaSlots& slots, double distance) {
  return distance * std::sin(pi / slots.count);
}

std::array<double, 4> geneva_motion(const GenevaSlots& slots, double crank) {
  const auto [t, before] = passage_at(crank);
  const double sense = slots.internal ? 1 : -1, step = full_turn / slots.count;
  const double past = sense * before * step;
  if (std::abs(t) >= entry(slots)) return {past + sense * std::copysign(step / 2, t), 0, 0, 0};
  const double s = std::sin(pi / slots.count), sine = std::sin(t), cosine = std::cos(t);
  const double d = 1 + s * s + sense * 2 * s * cosine, k = s * (s * s - 1);
  return {past + sense * std::atan2(s * sine, 1 + sense * s * cosine),
          sense * (s * cosine + sense * s * s) / d, sense * k * sine / (d * d),
          sense * k * (cosine * d + sense * 4 * s * sine * sine) / (d * d * d)};
}

}  // namespace linkwright::planar
