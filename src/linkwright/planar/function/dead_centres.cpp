// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/dead_centres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/quality.h"

namespace linkwright::planar {
namespace {

double square(double x) { return x * x; }

struct HalfAngles {
  double u, v;  // half swing, half imbalance
};
HalfAngles halves(const Strokes& s) {
  LINKWRIGHT_REQUIRE(s.swing >= 0 && s.swing < pi, "swing {} rad", s.swing);
  LINKWRIGHT_REQUIRE(std::abs(s.imbalance) < pi, "imbalance {} rad", s.imbalance);
  return {s.swing / 2, s.imbalance / 2};
}

// The square of a length is at_zero + by_x x, x = crank^2.
struct SquaredLength {
  double at_zero, by_x;
};
SquaredLength squared(StrokeLength which, const HalfAngles& h) {
  const double by_swing = square(std::sin(h.u));
  switch (which) {
    case StrokeLength::crank:
      return {0, 1};
    case StrokeLength::coupler:
      return {1, 0};
    case StrokeLength::rocker:
      return {square(std::sin(h.v)) / by_swing, square(std::cos(h.v)) / by_swing};
    case StrokeLength::ground:
      return {square(std::sin(h.u + h.v)) / by_swing, square(std::cos(h.u + h.v)) / by_swing};
    case StrokeLength::chord:
      break;
  }
  return {4 * square(std::sin(h.v)), 4 * square(std::cos(h.v))};
}

// The linkage at one input, with the rate of the output.
struct OutputMotion {
  LinkageMotion& motion;
  const LinkagePlan& plan;
  int body;
  bool slides;

  double rate(double input) const {
    const InputMotion turning{input, 1, 0};
    solve_motion(plan, std::span(&turning, 1), motion);
    if (motion.status != Status::done) return nan;
    const PartState<double> state = body_state(plan, motion, body);
    return slides ? state.velocity.x : state.speed;
  }
  double place() const {
    const PartState<double> state = body_state(plan, motion, body);
    return slides ? state.origin.x : std::atan2(state.direction.y, state.direction.x);
  }
};

}  // namespace

double imbalance_of(double time_ratio) {
  LINKWRIGHT_REQUIRE(time_ratio >= 1 && std::isfinite(time_ratio), "time ratio {}", time_ratio);
  return pi * (time_ratio - 1) / (time_ratio + 1);
}

double time_ratio_of(double imbalance) { return (pi + std::abs(imbalance)) / (pi - std::abs(imbalance)); }

double max_imbalance(double swing, bool with_crank) { return (pi + (with_crank ? swing : -swing)) / 2; }

std::optional<double> shortest_crank(const Strokes& strokes) {
  const auto [u, v] = halves(strokes);
  // At the limit, and within rounding of it, crank and coupler are equal.
  constexpr double below = 1 - 1e-12;
  if (std::abs(strokes.imbalance) >= below * max_imbalance(strokes.swing, strokes.imbalance < 0))
    return std::nullopt;
  return std::tan(std::abs(v)) * std::abs(std::tan(u + v));
}

StrokeLinkage stroke_linkage(const Strokes& strokes, double crank) {
  const HalfAngles h = halves(strokes);
  const double x = crank * crank, sine = std::sin(h.v), cosine = std::cos(h.v);
  const auto length = [&](StrokeLength which) {
    const SquaredLength s = squared(which, h);
    return std::sqrt(s.at_zero + s.by_x * x);
  };
  StrokeLinkage out;
  out.crank = crank;
  out.rocker = strokes.swing > 0 ? length(StrokeLength::rocker) : infinity;
  out.ground = strokes.swing > 0 ? length(StrokeLength::ground) : infinity;
  out.chord = length(StrokeLength::chord);
  out.offset = out.chord > 0 ? 2 * (1 - x) * sine * cosine / out.chord : 0;
  // Cosine of the angle where the crank lies along the ground link (across the guide).
  const double across = std::hypot(std::sin(h.u + h.v), crank * std::cos(h.u + h.v));
  const double most =
      ((1 - x) * std::abs(sine * std::cos(h.u + h.v)) + crank * across) / std::hypot(sine, crank * cosine);
  out.transmission_angle = most < 1 ? std::atan2(std::sqrt((1 - most) * (1 + most)), most) : 0;
  return out;
}

double length_of(const StrokeLinkage& linkage, StrokeLength which) {
  switch (which) {
    case StrokeLength::crank:
      return linkage.crank;
    case StrokeLength::coupler:
      return 1;
    case StrokeLength::rocker:
      return linkage.rocker;
    case StrokeLength::ground:
      return linkage.ground;
    case StrokeLength::chord:
      break;
  }
  return linkage.chord;
}

double best_crank(const Strokes& strokes) {
  const auto [u, v] = halves(strokes);
  LINKWRIGHT_REQUIRE(shortest_crank(strokes).has_value(), "no linkage has swing {} rad with imbalance {} rad",
                     strokes.swing, strokes.imbalance);
  if (strokes.imbalance == 0) return 0;
  const double t = square(std::tan(v)), w = square(std::tan(u + v));
  const auto cubic = [t, w](double x) { return ((x + 2 * t) * x - t) * x - t * (1 + t) * w; };
  // It falls from x = 0, where it may be zero, to its least value, and its root lies behind that.
  const double lowest = (std::sqrt(t * (4 * t + 3)) - 2 * t) / 3;
  return std::sqrt(math::zero_between(cubic, lowest, 1));
}

std::optional<double> crank_of_ratio(const Strokes& strokes, StrokeLength one, StrokeLength other,
                                     double ratio) {
  const HalfAngles h = halves(strokes);
  const SquaredLength a = squared(one, h), b = squared(other, h);
  const double by_x = a.by_x - ratio * ratio * b.by_x, x = (ratio * ratio * b.at_zero - a.at_zero) / by_x;
  // Lengths in one ratio whatever the crank leave rounding alone.
  constexpr double rounding = 1e-12;
  if (!(std::abs(by_x) > rounding * a.by_x) || !(x > 0) || !std::isfinite(x)) return std::nullopt;
  return std::sqrt(x);
}

double min_transmission_angle(const LinkagePlan& plan, const LinkageMotion& motion) {
  double least = pi / 2;
  for (std::size_t g = 0; g < plan.groups.size(); ++g)
    least = std::min(least, transmission_angle(plan, motion, g));
  return least;
}

std::optional<SweptStrokes> sweep_strokes(const Linkage& linkage, int body, bool slides, int samples) {
  const PlanResult planned = plan_linkage(linkage);
  LINKWRIGHT_REQUIRE(planned.problems.empty(), "the linkage cannot be solved");
  LINKWRIGHT_REQUIRE(linkage.driven.size() == 1, "{} inputs", linkage.driven.size());
  LinkageMotion motion(planned.plan);
  const OutputMotion output{motion, planned.plan, body, slides};
  const auto input = [samples](int k) { return 2 * pi * k / samples; };
  SweptStrokes out;
  std::array<double, 2> ends{};  // low, high
  std::array<int, 2> found{};
  double least = pi / 2;
  // The turn ends with the very value with which it began: a dead centre there is met once.
  const auto rate_at = [&](double angle) { return output.rate(angle < 2 * pi ? angle : angle - 2 * pi); };
  double before = rate_at(0);
  for (int k = 1; k <= samples; ++k) {
    const double rate = rate_at(input(k));
    if (!std::isfinite(rate) || !std::isfinite(before)) return std::nullopt;
    least = std::min(least, min_transmission_angle(planned.plan, motion));
    if ((rate > 0) != (before > 0)) {
      const std::size_t end = rate > 0 ? 0 : 1;
      const double at = math::zero_between(rate_at, input(k - 1), input(k));
      (void)rate_at(at);
      (end == 0 ? out.at_low : out.at_high) = at;
      ends[end] = output.place();
      ++found[end];
    }
    before = rate;
  }
  if (found[0] != 1 || found[1] != 1) return std::nullopt;
  out.swing = slides ? ends[1] - ends[0] : math::wrap_angle(ends[1] - ends[0]);
  if (out.swing < 0) out.swing += 2 * pi;
  out.rise = out.at_high - out.at_low;
  if (out.rise < 0) out.rise += 2 * pi;
  out.transmission_angle = least;
  return out;
}

}  // namespace linkwright::planar
