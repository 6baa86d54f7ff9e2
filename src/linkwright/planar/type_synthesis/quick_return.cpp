// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/quick_return.h"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/type_synthesis/curve.h"

namespace linkwright::planar {
namespace {

constexpr double beside = 0.5 * pi / 180;  // crank rotation from a dead centre to the places beside it

/// Place of the extreme of the parabola through three values at -1, 0, 1.
double vertex(double before, double at, double after) {
  const double curvature = before - 2 * at + after;
  return curvature == 0 ? 0 : 0.5 * (before - after) / curvature;
}

}  // namespace

MotionTarget quick_return_target(const QuickReturn& wanted) {
  LINKWRIGHT_REQUIRE(wanted.time_ratio >= 1 && wanted.range != 0 && wanted.size > 0,
                     "a quick return needs a time ratio of 1 or more, a range and a size: {}, {}, {}",
                     wanted.time_ratio, wanted.range, wanted.size);
  const bool slide = wanted.output == MachineOutput::slide;
  SampledStroke plain;
  plain.closed = true;
  // The root mean square travel of a slider that moves as a sine.
  plain.size = slide ? std::abs(wanted.range) / (2 * std::numbers::sqrt2) : wanted.size;
  plain.centre = slide ? 0.5 * wanted.range : 0.0;
  MotionTarget out(plain);
  out.output = wanted.output;
  out.timed = true, out.dense = false, out.turns = true;
  out.oriented = !slide;
  out.angle_length = 1;
  const double sense = wanted.clockwise ? -1 : 1;
  const double slow = 2 * pi * wanted.time_ratio / (1 + wanted.time_ratio);
  // Both dead centres; the places beside each, which have one value where the output stands; and both again
  // without a weight, since samples come in eights.
  out.count = 8;
  const std::array<double, 8> turned{0, slow, -beside, beside, slow - beside, slow + beside, 0, slow};
  const std::array<bool, 8> reached{false, true, false, false, true, true, false, true};
  const double as_speed = 1 / (2 * beside * beside);
  for (std::size_t k = 0; k < out.count; ++k) {
    out.turn[k] = sense * turned[k];
    out.weight[k] = k < 2 ? 1 : k < 6 ? as_speed : 0;
    const double value = reached[k] ? wanted.range : 0;
    out.x[k] = out.y[k] = 0;
    if (slide)
      out.x[k] = (value - plain.centre.real()) / plain.size;
    else
      out.angle[k] = value;
  }
  out.rests = {{2, 4}, {4, 6}};
  out.total_weight = 2;
  out.share = out.weight;
  out.met = 1e-6;
  return out;
}

MachineStrokes strokes_of(const QuickReturn& wanted, const MotionTarget& target,
                          const FittedMachine& machine) {
  constexpr std::size_t n = 1440;
  const bool slide = wanted.output == MachineOutput::slide;
  const double step = (wanted.clockwise ? -2 : 2) * pi / n;
  std::vector<double> angle(n), px(n), py(n), bx(n), by(n), value(n);
  for (std::size_t k = 0; k < n; ++k) angle[k] = machine.angle[0] + step * static_cast<double>(k);
  CurveTask task{.program = machine.shape.program,
                 .x = machine.shape.x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle.data(),
                 .count = n,
                 .px = px.data(),
                 .py = py.data()};
  if (!slide) task.bx = bx.data(), task.by = by.data();
  compute_curve(task);
  const double sign = wanted.range < 0 ? -1 : 1;
  for (std::size_t k = 0; k < n; ++k)
    value[k] =
        slide ? sign * target.stroke.size * px[k] : sign * std::arg(std::complex<double>(bx[k], by[k]));
  if (!slide) {
    for (std::size_t k = 1; k < n; ++k) value[k] = value[k - 1] + math::wrap_angle(value[k] - value[k - 1]);
    // An output that turns on has no dead centres.
    if (std::abs(value[n - 1] + math::wrap_angle(value[0] - value[n - 1]) - value[0]) > 1) return {};
  }
  MachineStrokes out;
  double least = infinity, most = -infinity, least_at = 0, most_at = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double before = value[(k + n - 1) % n], at = value[k], after = value[(k + 1) % n];
    const bool top = at >= before && at > after, bottom = at <= before && at < after;
    if (!top && !bottom) continue;
    ++out.extremes;
    const double offset = vertex(before, at, after), place = static_cast<double>(k) + offset;
    const double extreme = at - 0.25 * (before - after) * offset;
    if (top && extreme > most) most = extreme, most_at = place;
    if (bottom && extreme < least) least = extreme, least_at = place;
  }
  if (out.extremes < 2) return {};
  const double share = (most_at - least_at) / n, slow = share - std::floor(share);
  out.time_ratio = slow / (1 - slow);
  out.range = sign * (most - least);
  return out;
}

}  // namespace linkwright::planar
