// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/strut.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/detail/load_formula.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

double area(double diameter) { return pi / 4 * diameter * diameter; }

double gas_force(const GasSpring& g, double length) {
  return g.extended_force * (1 + (g.progression - 1) * (g.extended_length - length) / g.stroke);
}
double cylinder_force(const Cylinder& c, double pressure, double back_pressure) {
  return pressure * area(c.bore) - back_pressure * (area(c.bore) - area(c.rod));
}
double cylinder_force(const Cylinder& c) { return cylinder_force(c, c.pressure, c.back_pressure); }

// The integral of a table of factors over its argument from its first row; beyond its ends it is held.
double factor_integral(const LoadFactor& f, double argument) {
  const std::size_t n = f.argument.size();
  if (argument <= f.argument.front()) return f.factor.front() * (argument - f.argument.front());
  double sum = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const double width = f.argument[i] - f.argument[i - 1];
    const double covered = std::min(argument, f.argument[i]) - f.argument[i - 1];
    const double slope = (f.factor[i] - f.factor[i - 1]) / width;
    sum += covered * (f.factor[i - 1] + slope * covered / 2);
    if (argument <= f.argument[i]) return sum;
  }
  return sum + f.factor.back() * (argument - f.argument.back());
}

}  // namespace

Span span_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, const BodyPoint& first,
             const BodyPoint& second) {
  const auto point = [&](const BodyPoint& p) { return point_motion(l, plan, motion, p); };
  const PointMotion a = point(first), b = point(second);
  Span span{.first = a.position, .second = b.position};
  const math::Vec2 between = b.position - a.position;
  span.length = norm(between);
  if (span.length > 0) span.along = (1 / span.length) * between;
  span.rate = dot(span.along, b.velocity - a.velocity);
  return span;
}

double push_of(const Strut& s, const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
               const Span& span, double time, double input) {
  if (s.gas) return gas_force(*s.gas, span.length);
  if (s.formula) {
    const std::array<double, 2> values = values_of(*s.formula, l, plan, motion, time);
    return s.cylinder ? cylinder_force(*s.cylinder, values[0], values[1]) : values[0];
  }
  if (s.cylinder) return cylinder_force(*s.cylinder);
  const bool turns = !plan.rotary.empty() && plan.rotary[0];
  switch (s.factor.against) {
    case LoadArgument::input:
      return s.force * factor_at(s.factor, input, turns);
    case LoadArgument::time:
      return s.force * factor_at(s.factor, time, turns);
    case LoadArgument::speed:
      return s.force * factor_at(s.factor, span.rate, turns);
    case LoadArgument::length:
      return s.force * factor_at(s.factor, span.length, turns);
    case LoadArgument::constant:
    case LoadArgument::x:
    case LoadArgument::y:
      break;
  }
  return s.force;
}

bool stores_energy(const Strut& s) {
  if (s.formula) return false;  // a law of its own, whose integral is not known
  return s.gas || s.cylinder || s.factor.against == LoadArgument::constant ||
         s.factor.against == LoadArgument::length;
}

double stored_energy(const Strut& s, double length) {
  if (!stores_energy(s)) return 0;
  if (s.gas) {
    const double shorter = s.gas->extended_length - length;
    return s.gas->extended_force * shorter * (1 + (s.gas->progression - 1) * shorter / s.gas->stroke / 2);
  }
  if (s.cylinder) return -cylinder_force(*s.cylinder) * length;
  if (s.factor.against == LoadArgument::constant) return -s.force * length;
  return -s.force * factor_integral(s.factor, length);
}

bool beyond_stroke(const Strut& s, double length) {
  if (!s.gas) return false;
  const double rounding = 1e-9 * s.gas->extended_length, longest = s.gas->extended_length;
  return length > longest + rounding || length < longest - s.gas->stroke - rounding;
}

LoadWithoutValue load_without_value(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                                    double time) {
  const auto without = [&](const auto& load) {
    if (!load.formula) return false;
    const std::array<double, 2> values = values_of(*load.formula, l, plan, motion, time);
    return !std::isfinite(values[0] + values[1]);
  };
  for (const Strut& s : l.struts) {
    if (!s.gas && !s.formula) continue;
    const double length = span_of(l, plan, motion, s.first, s.second).length;
    if (s.gas ? beyond_stroke(s, length) : without(s)) return {.strut = &s, .length = length};
  }
  for (const PointForce& f : l.forces)
    if (without(f)) return {.force = &f};
  for (const BodyTorque& t : l.torques)
    if (without(t)) return {.torque = &t};
  return {};
}

Sentence without_value_text(const LoadWithoutValue& load) {
  LINKWRIGHT_REQUIRE(load, "all loads have values, with a length of {} m", load.length);
  if (load.force) return say("the formula of force '{}' has no value", load.force->name);
  if (load.torque) return say("the formula of torque '{}' has no value", load.torque->name);
  const Strut& s = *load.strut;
  if (s.formula)
    return say("the formula of strut '{}' has no value at a length of {}", s.name,
               millimetres(load.length, 5));
  return say("gas spring '{}' would be {} long; it goes from {} to {}", s.name, millimetres(load.length, 5),
             millimetres(s.gas->extended_length - s.gas->stroke, 5), millimetres(s.gas->extended_length, 5));
}

}  // namespace linkwright::planar
