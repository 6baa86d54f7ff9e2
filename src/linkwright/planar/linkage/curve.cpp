// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/detail/curve_equations.h"

namespace linkwright::planar {
namespace {

// Lengths of steps, in units of the scaled displacement (see CurveEquations).
constexpr double longest_step = 0.15, shortest_step = 1e-10;
// Curves that pass each other nearer than the square of this count as crossing.
constexpr double crossing_step = 1e-5;
constexpr int max_steps = 20000;
constexpr double far_away = 1e3;  // sizes of the linkage

double alike(const CurveNode& a, std::span<const PartState<double>> b, const CurveEquations& equations) {
  double apart = 0;
  for (const int p : equations.parts())
    apart = std::max({apart, norm(a.parts[at(p)].origin - b[at(p)].origin) / equations.plan().size,
                      norm(a.parts[at(p)].direction - b[at(p)].direction)});
  return apart;
}

// The sign of a group's assembly mode that places show; 0 where both meet.
double shown_mode(const Group& g, std::span<const PartState<double>> parts) {
  return mode_side(
      g, [&](const PartPoint& p) { return point_on(parts[at(p.part)], p.at); },
      [&](const PartPoint& p) { return rotate(parts[at(p.part)].direction, p.direction); });
}

}  // namespace

InputLine along_input(std::span<const double> inputs, int input) {
  InputLine line{{inputs.begin(), inputs.end()}, std::vector<double>(inputs.size(), 0.0)};
  line.base[at(input)] = 0;
  line.direction[at(input)] = 1;
  return line;
}
InputLine line_between(std::span<const double> from, std::span<const double> to) {
  InputLine line{{from.begin(), from.end()}, {}};
  for (std::size_t i = 0; i < from.size(); ++i) line.direction.push_back(to[i] - from[i]);
  return line;
}

struct ModeCurve::Memory {
  Memory(const LinkagePlan& plan, InputLine line, double turn_, AtChangePoint policy_)
      : equations(plan, std::move(line)), turn(turn_), policy(policy_) {}

  CurveEquations equations;
  double turn;
  AtChangePoint policy;
  std::vector<CurveNode> nodes;  // rising values
  RangeEnd low, high;
  double period = 0, start = 0;
  std::vector<double> changes;
  bool lost = false;

  // ---- following ----------------------------------------------------------------------------------------

  CurveNode interpolated(const CurveNode& a, const CurveNode& b, double share) const {
    const double h = b.along - a.along, s = share, r = 1 - s;
    const double a0 = r * r * (1 + 2 * s), b0 = s * s * (1 + 2 * r), a1 = h * s * r * r, b1 = -h * s * s * r;
    CurveNode out = a;
    out.along = a.along + s * h;
    out.value = a0 * a.value + b0 * b.value + a1 * a.slope + b1 * b.slope;
    for (const int p : equations.parts()) {
      const PartState<double>&x = a.parts[at(p)], &y = b.parts[at(p)];
      PartState<double>& part = out.parts[at(p)];
      part.origin = a0 * x.origin + b0 * y.origin + a1 * x.velocity + b1 * y.velocity;
      const double turned = angle_of(rotate_inverse(x.direction, y.direction));
      part.direction = math::rotate(x.direction, math::unit(b0 * turned + a1 * x.speed + b1 * y.speed));
      part.velocity = r * x.velocity + s * y.velocity;
      part.speed = r * x.speed + s * y.speed;
    }
    out.slope = r * a.slope + s * b.slope;
    return out;
  }

  // The place a step ahead of `a`; nothing when the corrector does not get there.
  std::optional<CurveNode> ahead(const CurveNode& a, const Eigen::VectorXd& direction,
                                 const Eigen::VectorXd& bend, double step, double& moved) {
    CurveNode b = a;
    const Eigen::VectorXd way = step * direction + (0.5 * step * step) * bend;
    equations.move(b, way);
    moved = equations.correct(b, direction);
    if (!std::isfinite(moved)) return {};
    equations.set_tangent(b, equations.tangent_along(direction));
    b.along = a.along + step;
    return b;
  }

  struct Trace {
    RangeEnd end;
    std::vector<CurveNode> nodes;  // without the start
    std::vector<double> changes;
    double period = 0;
  };

  // Follows the curve from `a`, where the value goes with `sense`, to `bound`.
  Trace trace(CurveNode a, double sense, double bound) {
    Trace out;
    Eigen::VectorXd direction = equations.tangent(a), bend = Eigen::VectorXd::Zero(direction.size());
    equations.factorise(a, direction);
    Determinant border = equations.determinant();
    const CurveNode origin = a;
    double step = 0.02;
    int turns = 0;
    bool widely_lost = false;
    for (int i = 0; i < max_steps; ++i) {
      if (step < shortest_step) {
        widely_lost = true;
        break;
      }
      double moved = 0;
      const std::optional<CurveNode> next = ahead(a, direction, bend, step, moved);
      const auto shorten = [&] { step *= 0.5, bend.setZero(); };
      if (!next || moved > 0.1 * step) {
        shorten();
        continue;
      }
      const Eigen::VectorXd after = equations.tangent(*next);
      const Determinant beyond = equations.determinant();
      if (equations.product(direction, after) < 0.98 || !smooth(a, *next) ||
          (step > crossing_step && !turns_once(a, *next, sense))) {
        shorten();
        continue;
      }
      const bool crosses = beyond.sign != border.sign;
      if (crosses && step > crossing_step) {
        shorten();
        continue;
      }
      if (crosses) {
        const double share = 1 / (1 + std::exp(beyond.log - border.log));
        const CurveNode there = interpolated(a, *next, share);
        const double value = there.value;
        if (policy != AtChangePoint::smooth) {
          out.nodes.push_back(there);
          out.end = {value, EndKind::change_point, {}};
          return out;
        }
        out.changes.push_back(value);
      }
      if (next->slope * sense < 0) {
        // The value turns back within the step.
        const double fold = math::zero_between(
            [&](double h) {
              if (h == 0) return a.slope;
              double m = 0;
              const std::optional<CurveNode> there = ahead(a, direction, bend, h, m);
              return there ? there->slope : nan;
            },
            0, step);
        double m = 0;
        const std::optional<CurveNode> end = fold > 0 ? ahead(a, direction, bend, fold, m) : std::nullopt;
        if (end && (end->value - a.value) * sense > 0) out.nodes.push_back(*end);
        out.end = {(end ? *end : a).value, EndKind::limit, {}};
        return out;
      }
      border = beyond;
      bend = (1 / step) * (after - direction);
      if (crosses) bend.setZero();
      direction = after;
      a = *next;
      out.nodes.push_back(a);
      step = std::min(longest_step, step * (moved < 0.01 * step ? 1.6 : moved < 0.03 * step ? 1.1 : 0.8));
      if (turn > 0 && (a.value - origin.value) * sense >= (turns + 1) * turn) {
        ++turns;
        std::optional<CurveNode> there = exact(out.nodes, origin.value + sense * turns * turn, sense);
        if (there && alike(*there, origin.parts, equations) < 1e-6) {
          out.period = turns * turn;
          out.end = {origin.value + sense * out.period, EndKind::bound, {}};
          return out;
        }
      }
      if ((a.value - bound) * sense >= 0) {
        out.end = {bound, EndKind::bound, {}};
        return out;
      }
      for (const int p : equations.parts())
        if (!(norm(a.parts[at(p)].origin - origin.parts[at(p)].origin) < far_away * equations.plan().size)) {
          out.end = {a.value, EndKind::singular, {}};
          return out;
        }
    }
    lost = lost || widely_lost;
    out.end = {a.value, EndKind::limit, {}};
    return out;
  }

  // True if a cubic through both ends meets the equations in the middle, and follows the tangents of the ends
  // between them.
  bool smooth(const CurveNode& a, const CurveNode& b) {
    const double h = b.along - a.along;
    const CurveNode middle = interpolated(a, b, 0.5);
    equations.evaluate(middle, false);
    if (!(equations.largest_residual() <= 1e-3 * h + equations.rounding(middle))) return false;
    double worst = std::abs(b.value - a.value - 0.5 * h * (a.slope + b.slope)) * equations.unit();
    for (const int p : equations.parts()) {
      const PartState<double>&x = a.parts[at(p)], &y = b.parts[at(p)];
      worst = std::max(
          {worst, norm(y.origin - x.origin - (0.5 * h) * (x.velocity + y.velocity)) / equations.plan().size,
           std::abs(angle_of(rotate_inverse(x.direction, y.direction)) - 0.5 * h * (x.speed + y.speed))});
    }
    return worst <= 0.05 * h;
  }

  // True if the value turns back at most once between the ends: a step can leap over two dead points side by
  // side, between which the value goes back a little, and looks like one without any. The slope in the middle
  // shows that: a parabola through it and those of the ends must stay clear of zero by a quarter of what it
  // changes.
  bool turns_once(const CurveNode& a, const CurveNode& b, double sense) {
    const double first = a.slope * sense, last = b.slope * sense;
    if (last < 0) return true;
    CurveNode middle = interpolated(a, b, 0.5);
    const Eigen::VectorXd direction = equations.tangent(b);
    equations.factorise(middle, direction);
    equations.set_tangent(middle, equations.tangent_along(direction));
    const double half = middle.slope * sense, bend = 2 * (first + last - 2 * half),
                 rise = last - first - bend;
    double least = std::min({first, half, last});
    const double lowest = bend > 0 ? -rise / (2 * bend) : -1;
    if (lowest > 0 && lowest < 1) least = std::min(least, first + lowest * (rise + lowest * bend));
    return least >= 0.25 * (std::max({first, half, last}) - least);
  }

  // The place at a value between those of nodes that rise (sense 1) or fall.
  std::optional<CurveNode> exact(const std::vector<CurveNode>& list, double value, double sense) {
    const auto beyond = std::find_if(list.begin(), list.end(),
                                     [&](const CurveNode& n) { return (n.value - value) * sense >= 0; });
    if (beyond == list.end() || beyond == list.begin()) return {};
    return between(*(beyond - 1), *beyond, value);
  }
  std::optional<CurveNode> between(const CurveNode& a, const CurveNode& b, double value) {
    const double sense = b.value > a.value ? 1 : -1;
    const auto before = [&](double s) { return (interpolated(a, b, s).value - value) * sense < 0; };
    CurveNode y = interpolated(a, b, math::bisect(before, 0, 1, {.halvings = 60}).outside);
    for (int i = 0; i < 8; ++i) {
      Eigen::VectorXd direction = equations.tangent(y);
      direction /= equations.length(direction);
      const double moved = equations.correct(y, direction);
      if (!(moved <= 0.1 * std::abs(b.along - a.along))) return {};
      equations.set_tangent(y, equations.tangent_along(direction));
      const double error = value - y.value;
      if (std::abs(error) <= 4 * tolerance::epsilon * (std::abs(value) + 1 / equations.unit()) ||
          y.slope == 0)
        break;
      // At a dead point the value hardly depends on the length.
      const double most = 0.5 * std::abs(b.along - a.along), way = error / y.slope;
      if (std::abs(way) > most) break;
      equations.move(y, way * equations.tangent(y));
    }
    return y;
  }

  // ---- what is asked ------------------------------------------------------------------------------------

  void run(double from, std::span<const PartState<double>> parts, double low_bound, double high_bound) {
    start = from;
    CurveNode first{0, from, 0, {parts.begin(), parts.end()}};
    // A direction to begin with: along the value, where it is not a dead point.
    Eigen::VectorXd up = Eigen::VectorXd::Zero(equations.size() + 1);
    up[equations.size()] = 1;
    equations.factorise(first, up);
    Eigen::VectorXd t = equations.tangent_along(up);
    if (!t.allFinite()) {
      low = high = {from, EndKind::singular, {}};
      lost = true;
      nodes = {first};
      return;
    }
    equations.set_tangent(first, t);
    nodes = {first};
    const Trace forward =
        from < high_bound ? trace(first, 1, high_bound) : Trace{{from, EndKind::bound, {}}, {}, {}, 0};
    nodes.insert(nodes.end(), forward.nodes.begin(), forward.nodes.end());
    high = forward.end;
    changes = forward.changes;
    period = forward.period;
    low = {from, EndKind::bound, {}};
    if (period > 0 || from <= low_bound) return name_ends();
    CurveNode turned = first;
    equations.set_tangent(turned, -t);
    Trace backward = trace(turned, -1, low_bound);
    for (CurveNode& n : backward.nodes) {
      n.along = -n.along;
      n.slope = -n.slope;
      for (PartState<double>& p : n.parts) p.velocity = -p.velocity, p.speed = -p.speed;
      nodes.insert(nodes.begin(), std::move(n));
    }
    low = backward.end;
    changes.insert(changes.end(), backward.changes.begin(), backward.changes.end());
    std::sort(changes.begin(), changes.end());
    name_ends();
  }
  // The group at each end whose determinant is nearest to zero.
  void name_ends() {
    for (RangeEnd* end : {&low, &high}) {
      if (end->kind == EndKind::bound) continue;
      // Beside the end, where the groups still say it.
      const double inside = end == &low ? 1 : -1;
      LinkageMotion motion(equations.plan());
      const double width = nodes.back().value - nodes.front().value;
      const double value = end->value + inside * 1e-6 * width;
      if (width > 0) place(value, motion);
      equations.put(value);
      solve_position(equations.plan(), equations.inputs(), motion);
      int nearest = equations.groups().back();
      double least = 2;
      for (const int k : equations.groups()) {
        if (!traits_of(equations.plan().groups[at(k)]).closes_loop) continue;
        if (motion.failed_group >= 0 && k > motion.failed_group) break;
        if (std::abs(motion.groups[at(k)].sine) < least)
          least = std::abs(motion.groups[at(k)].sine), nearest = k;
      }
      end->groups = {nearest};
    }
  }

  // The value within the nodes; whole turns do not matter.
  double within(double value) const {
    if (period > 0) return value - period * std::floor((value - start) / period);
    if (turn <= 0) return value;
    const double slack = 1e-12 * (1 + std::abs(value));
    if (value < low.value - slack) return value + turn * std::ceil((low.value - slack - value) / turn);
    if (value > high.value + slack) return value - turn * std::ceil((value - high.value - slack) / turn);
    return value;
  }

  Status place(double asked, LinkageMotion& motion) {
    const double value = within(asked);
    const double slack = 1e-12 * (1 / equations.unit() + std::abs(value));
    const bool below = value<low.value - slack, above = value> high.value + slack;
    const CurveNode* node = nullptr;
    std::optional<CurveNode> here;
    if (below || value <= nodes.front().value) {
      node = &nodes.front();
    } else if (above || value >= nodes.back().value) {
      node = &nodes.back();
    } else {
      const auto next = std::upper_bound(nodes.begin(), nodes.end(), value,
                                         [](double v, const CurveNode& n) { return v < n.value; });
      here = between(*(next - 1), *next, value);
      // Only where rounding rules, beside a dead point.
      if (!here) here = interpolated(*(next - 1), *next, 0.5);
      node = &*here;
    }
    for (const int p : equations.parts()) {
      motion.parts[at(p)].origin = node->parts[at(p)].origin;
      motion.parts[at(p)].direction = node->parts[at(p)].direction;
    }
    for (const int k : equations.groups()) {
      const Group& g = equations.plan().groups[at(k)];
      if (!traits_of(g).has_modes) continue;
      const double side = shown_mode(g, motion.parts);
      if (side != 0) motion.modes[at(k)] = side < 0 ? -1 : 1;
    }
    if (!below && !above) return Status::done;
    return (below ? low : high).kind == EndKind::change_point ? Status::limit_reached : Status::no_assembly;
  }

  double gap(double asked) {
    const double value = within(asked);
    CurveNode y = value < low.value ? nodes.front() : nodes.back();
    y.value = value;
    return equations.settle(y, true) * equations.plan().size;
  }
};

ModeCurve::ModeCurve(const LinkagePlan& plan, InputLine line, double start,
                     std::span<const PartState<double>> parts, double low, double high, double turn,
                     AtChangePoint policy) {
  LINKWRIGHT_REQUIRE(line.base.size() == plan.inputs() && line.direction.size() == plan.inputs(),
                     "the linkage has {} inputs, got {} and {}", plan.inputs(), line.base.size(),
                     line.direction.size());
  LINKWRIGHT_REQUIRE(!plan.closed_form(), "the plan is in closed form: use branch_path");
  LINKWRIGHT_REQUIRE(
      parts.size() == plan.parts.size() && low <= start && start <= high && std::isfinite(high - low),
      "{} parts, start {} in {} to {}", parts.size(), start, low, high);
  memory_ = std::make_unique<Memory>(plan, std::move(line), turn, policy);
  memory_->run(start, parts, low, high);
}
ModeCurve::~ModeCurve() = default;
ModeCurve::ModeCurve(ModeCurve&&) noexcept = default;
ModeCurve& ModeCurve::operator=(ModeCurve&&) noexcept = default;

const RangeEnd& ModeCurve::low() const { return memory_->low; }
const RangeEnd& ModeCurve::high() const { return memory_->high; }
double ModeCurve::period() const { return memory_->period; }
std::span<const double> ModeCurve::change_points() const { return memory_->changes; }
bool ModeCurve::lost() const { return memory_->lost; }
std::size_t ModeCurve::nodes() const { return memory_->nodes.size(); }
Status ModeCurve::place(double value, LinkageMotion& motion) { return memory_->place(value, motion); }
double ModeCurve::gap(double value) { return memory_->gap(value); }

FollowReport follow(const LinkagePlan& plan, std::span<const double> from, std::span<const double> to,
                    LinkageMotion& motion) {
  LINKWRIGHT_REQUIRE(from.size() == plan.inputs() && to.size() == plan.inputs(),
                     "the linkage has {} inputs, got {} and {}", plan.inputs(), from.size(), to.size());
  const auto solve = [&](std::span<const double> values) {
    std::vector<InputMotion> inputs;
    for (const double v : values) inputs.push_back({v, 0, 0});
    solve_position(plan, inputs, motion);
    return motion.status == Status::done;
  };
  if (plan.closed_form()) return {solve(to), 1};
  if (!solve(from)) return {false, 0};
  if (std::equal(from.begin(), from.end(), to.begin())) return {};
  ModeCurve curve(plan, line_between(from, to), 0, motion.parts, 0, 1, 0, AtChangePoint::stop);
  if (curve.high().kind == EndKind::bound) {
    curve.place(1, motion);
    return {solve(to), 1};
  }
  const double reached = curve.high().value;
  curve.place(reached, motion);
  motion.status = Status::limit_reached;
  return {false, reached};
}

bool nearest_place(const LinkagePlan& plan, const InputLine& line, double& value,
                   std::span<PartState<double>> parts) {
  CurveEquations equations(plan, line);
  CurveNode y{0, value, 0, {parts.begin(), parts.end()}};
  if (!(equations.settle(y, false) <= 1e3 * equations.rounding(y))) return false;
  value = y.value;
  std::copy(y.parts.begin(), y.parts.end(), parts.begin());
  return true;
}

}  // namespace linkwright::planar
