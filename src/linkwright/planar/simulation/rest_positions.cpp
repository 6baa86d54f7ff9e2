// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/rest_positions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/simulation/holding.h"
#include "linkwright/planar/simulation/static_forces.h"

namespace linkwright::planar {
namespace {

constexpr double vanishing = 1e-9;  // of the largest force: where the force touches zero
constexpr double balance_rounding = 1e-12;

// The forces along one range of the free input.
class RestScan {
 public:
  RestScan(const Linkage& l, const LinkagePlan& plan, const RestSearch& search, StaticForces& forces)
      : l_(l),
        plan_(plan),
        forces_(forces),
        free_(search.free),
        samples_(search.samples),
        is_given_(search.range.has_value()),
        step_(1e-3 * (plan.rotary[search.free] ? 1 : plan.size)),
        values_(search.inputs) {}

  // Cuts a range of the assembly where gas springs end, and finds the rest positions of each piece.
  void run(const InputRange& range, RestPositions& out) {
    if (!range.modes.empty()) forces_.motion.modes = range.modes;
    const double from = range.from.value, to = range.to.value, width = to - from;
    // Close to dead points, where both modes meet, velocities grow without bound.
    constexpr double off = 1e-9;
    const double first = from + (range.from.kind == EndKind::bound ? 0 : off * width),
                 last = to - (range.to.kind == EndKind::bound ? 0 : off * width);
    std::vector<double> at;
    for (int i = 0; i <= samples_; ++i)
      at.push_back(i == samples_ ? last : first + (last - first) * i / samples_);
    std::size_t i = 0;
    while (i < at.size()) {
      if (!is_good(at[i])) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end + 1 < at.size() && is_good(at[end + 1])) ++end;
      RestRange piece{.from = from, .to = to, .modes = range.modes};
      piece.full_turn = range.full_turn && i == 0 && end + 1 == at.size();
      std::vector<double> values(at.begin() + static_cast<std::ptrdiff_t>(i),
                                 at.begin() + static_cast<std::ptrdiff_t>(end) + 1);
      const auto good = [&](double value) { return is_good(value); };
      if (i > 0) {
        piece.from = math::bisect(good, at[i], at[i - 1], {.relative = 1e-14}).inside;
        piece.stop_below = true;
        values.insert(values.begin(), piece.from);
      } else {
        piece.stop_below = is_given_ && !piece.full_turn && range.from.kind == EndKind::bound;
        piece.dead_below = !piece.full_turn && range.from.kind != EndKind::bound;
      }
      if (end + 1 < at.size()) {
        piece.to = math::bisect(good, at[end], at[end + 1], {.relative = 1e-14}).inside;
        piece.stop_above = true;
        values.push_back(piece.to);
      } else {
        piece.stop_above = is_given_ && !piece.full_turn && range.to.kind == EndKind::bound;
        piece.dead_above = !piece.full_turn && range.to.kind != EndKind::bound;
      }
      values.erase(std::unique(values.begin(), values.end()), values.end());
      examine(std::move(piece), values, out);
      i = end + 1;
    }
  }

 private:
  bool is_good(double value) {
    values_[free_] = value;
    return forces_.solve(values_) == Status::done;
  }
  double force(double value) { return is_good(value) ? forces_.force[0] : nan; }

  void examine(RestRange piece, const std::vector<double>& values, RestPositions& out) {
    double largest = 0, scale = 0;
    for (const double value : values) {
      piece.value.push_back(value);
      piece.force.push_back(force(value));
      piece.potential.push_back(forces_.potential());
      largest = std::max(largest, std::abs(piece.force.back()));
      scale = std::max(scale, forces_.scale);
    }
    range_ = out.ranges.size();
    piece.balanced = largest <= balance_rounding * scale;
    low_ = values.front(), high_ = values.back();
    if (!piece.balanced) {
      const std::size_t before = out.positions.size();
      zeros(piece, largest, out);
      ends(piece, out);
      std::sort(out.positions.begin() + static_cast<std::ptrdiff_t>(before), out.positions.end(),
                [](const RestPosition& a, const RestPosition& b) { return a.value < b.value; });
    }
    out.ranges.push_back(std::move(piece));
  }

  void zeros(const RestRange& piece, double largest, RestPositions& out) {
    const std::vector<double>&x = piece.value, &q = piece.force;
    const auto positive = [](double v) { return v >= 0; };
    std::vector<double> found;
    const std::size_t n = x.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      if (positive(q[i]) != positive(q[i + 1]))
        found.push_back(math::zero_between([&](double v) { return force(v); }, x[i], x[i + 1]));
    // The seam of a full turn is one place.
    if (piece.full_turn && found.size() > 1 && found.back() - found.front() > full_turn - 1e-9)
      found.pop_back();
    for (const double value : found) add(value, false, out);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      if (std::abs(q[i]) > std::abs(q[i - 1]) || std::abs(q[i]) > std::abs(q[i + 1])) continue;
      if (positive(q[i - 1]) != positive(q[i]) || positive(q[i]) != positive(q[i + 1])) continue;
      const double value = least_between(x[i - 1], x[i + 1]);
      if (std::abs(force(value)) <= vanishing * largest) add(value, true, out);
    }
  }

  // The place of the least |Q|, by the golden section; near it Q is a parabola.
  double least_between(double a, double b) {
    const double golden = (3 - std::sqrt(5.0)) / 2;
    for (int i = 0; i < 60; ++i) {
      const double left = a + golden * (b - a), right = b - golden * (b - a);
      if (std::abs(force(left)) <= std::abs(force(right)))
        b = right;
      else
        a = left;
    }
    return (a + b) / 2;
  }

  void ends(const RestRange& piece, RestPositions& out) {
    const auto rests = [&](double value) {
      return std::any_of(out.positions.begin(), out.positions.end(), [&](const RestPosition& p) {
        return p.range == range_ && std::abs(p.value - value) < 1e-9 * step_;
      });
    };
    const auto add_end = [&](double value, double pressing) {
      if (!(pressing > 0) || rests(value)) return;
      RestPosition& p = add(value, false, out);
      p.kind = RestKind::at_end;
      p.stiffness = nan;
      p.force = force(value);
      // The stop that the joint stands on balances the force by virtual work.
      constexpr double near = 1e-9;  // rad, and sizes of the linkage
      for (std::size_t k = 0; k < l_.stops.size(); ++k) {
        const bool pin = l_.joints[at(l_.stops[k].joint)].type == JointType::revolute;
        const double gap = stop_motion(l_, plan_, forces_.motion, k).gap / (pin ? 1 : plan_.size);
        const double effort = -p.force / forces_.stop_rates[k];
        if (l_.stops[k].stiffness || !(std::abs(gap) <= near) || !(effort > 0)) continue;
        p.stop = static_cast<int>(k);
        p.stop_effort = effort;
      }
    };
    if (piece.stop_below) add_end(piece.value.front(), -piece.force.front());
    if (piece.stop_above) add_end(piece.value.back(), piece.force.back());
  }

  RestPosition& add(double value, bool touches, RestPositions& out) {
    RestPosition p{.value = value, .range = range_};
    p.stiffness = stiffness(value);
    is_good(value);
    p.mass = forces_.masses()[0];
    p.potential = forces_.potential();
    p.damping = forces_.dampings()[0];
    p.kind = touches ? RestKind::marginal : p.stiffness > 0 ? RestKind::stable : RestKind::unstable;
    return out.positions.emplace_back(p);
  }

  // The differences of exact forces at four places about it, of the fourth order.
  double stiffness(double value) {
    const double room = std::min(value - low_, high_ - value) / 2.5;
    if (room <= 1e-6 * step_) {  // at the end of a range, from the side that is there
      const double inward = value - low_ < high_ - value ? 1e-5 * step_ : -1e-5 * step_;
      return -(force(value + inward) - force(value)) / inward;
    }
    const double h = std::min(step_, room);
    return -(8 * (force(value + h) - force(value - h)) - (force(value + 2 * h) - force(value - 2 * h))) /
           (12 * h);
  }

  const Linkage& l_;
  const LinkagePlan& plan_;
  StaticForces& forces_;
  std::size_t free_;
  int samples_;
  bool is_given_;
  double step_;
  std::vector<double> values_;
  std::size_t range_ = 0;
  double low_ = 0, high_ = 0;
};

// The range of a search, cut to what rigid stops leave of the free joint; the range to one stop alone ends a
// turn, or eight sizes of the linkage, off it.
std::optional<std::array<double, 2>> between_stops(const Linkage& l, const LinkagePlan& plan,
                                                   const RestSearch& search) {
  double low = -infinity, high = infinity;
  for (const JointStop& s : l.stops) {
    if (s.joint != l.driven[search.free] || s.stiffness) continue;
    (s.side > 0 ? low : high) = s.limit;
  }
  if (search.range) return {{std::max((*search.range)[0], low), std::min((*search.range)[1], high)}};
  if (!std::isfinite(low) && !std::isfinite(high)) return std::nullopt;
  const double reach = plan.rotary[search.free] ? full_turn : 8 * plan.size;
  if (!std::isfinite(low)) low = high - reach;
  if (!std::isfinite(high)) high = low + reach;
  return {{low, high}};
}

// The forces with and without a load along a range of the free input.
class LoadPathScan {
 public:
  LoadPathScan(const Linkage& linkage, const Linkage& unloaded, const LinkagePlan& plan,
               const RestSearch& search, LinkageAssembly* assembly)
      : with_(linkage, plan, {search.free}, assembly),
        without_(unloaded, plan, {search.free}, assembly),
        free_(search.free),
        values_(search.inputs) {}

  LoadPath run(const RestRange& range) {
    for (StaticForces* forces : {&with_, &without_})
      if (!range.modes.empty()) forces->motion.modes = range.modes;
    LoadPath out{.value = range.value};
    std::vector<double> work;
    for (const double value : range.value) {
      out.factor.push_back(factor(value));
      work.push_back(work_);
    }
    const std::size_t n = out.value.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, n - 1);
      // By the derivative of Q + f W = 0 along the path the stiffness is W df/dq.
      out.stable.push_back((out.factor[b] - out.factor[a]) * work[i] > 0 ? 1 : 0);
    }
    for (std::size_t i = 0; i + 1 < n; ++i)
      if (out.factor[i] * out.factor[i + 1] <= 0 && out.factor[i + 1] != 0 && work[i] * work[i + 1] > 0 &&
          out.stable[i] + out.stable[i + 1] > 0)
        out.ways.push_back(way(out, i));
    return out;
  }

 private:
  // The multiple of the load with which it rests there; notes the force of the load itself.
  double factor(double value) {
    values_[free_] = value;
    if (with_.solve(values_) != Status::done || without_.solve(values_) != Status::done) return work_ = nan;
    work_ = with_.force[0] - without_.force[0];
    return std::abs(work_) > balance_rounding * with_.scale ? -without_.force[0] / work_ : nan;
  }

  // From the zero between samples i and i + 1 on, in the sense in which the factor rises.
  LoadPath::Way way(const LoadPath& path, std::size_t i) {
    const std::vector<double>&x = path.value, &f = path.factor;
    LoadPath::Way out;
    out.from = f[i] == 0 ? x[i] : math::zero_between([&](double v) { return factor(v); }, x[i], x[i + 1]);
    const std::ptrdiff_t step = f[i + 1] > f[i] ? 1 : -1;
    std::ptrdiff_t k = static_cast<std::ptrdiff_t>(step > 0 ? i : i + 1);
    const auto inside = [&](std::ptrdiff_t m) { return m >= 0 && m < static_cast<std::ptrdiff_t>(x.size()); };
    const auto value = [&](std::ptrdiff_t m) { return x[static_cast<std::size_t>(m)]; };
    const auto multiple = [&](std::ptrdiff_t m) { return f[static_cast<std::size_t>(m)]; };
    while (inside(k + step) && multiple(k + step) > multiple(k)) {
      if (multiple(k + step) >= 1) {
        out.to = math::zero_between([&](double v) { return factor(v) - 1; }, value(k), value(k + step));
        return out;
      }
      k += step;
    }
    out.snaps = inside(k + step) && std::isfinite(multiple(k + step));
    out.leaves = !out.snaps;
    out.to = value(k);
    if (out.snaps)
      out.to = math::minimum_about([&](double v) { return -factor(v); }, value(k - 1), value(k), value(k + 1),
                                   {.absolute = 1e-12 * std::abs(value(k + 1) - value(k - 1))})
                   .at;
    out.factor = factor(out.to);
    // The fold itself may lie beyond the full load.
    if (out.snaps && out.factor >= 1) {
      out.snaps = false;
      out.to = math::zero_between([&](double v) { return factor(v) - 1; }, value(k - step), out.to);
      out.factor = 1;
    }
    return out;
  }

  StaticForces with_, without_;
  std::size_t free_;
  std::vector<double> values_;
  double work_ = 0;
};

}  // namespace

double RestPosition::frequency() const {
  return kind == RestKind::stable && mass > 0 ? std::sqrt(stiffness / mass) / full_turn : nan;
}
double RestPosition::damping_ratio() const {
  return kind == RestKind::stable && mass > 0 ? damping / (2 * std::sqrt(stiffness * mass)) : nan;
}

RestPositions rest_positions(const Linkage& linkage, const LinkagePlan& plan, const RestSearch& search,
                             const RunContext* context) {
  LINKWRIGHT_REQUIRE(search.inputs.size() == plan.inputs() && search.free < plan.inputs(),
                     "the linkage has {} inputs, got {} with the free one {}", plan.inputs(),
                     search.inputs.size(), search.free);
  LINKWRIGHT_REQUIRE(search.samples >= 16, "{} samples are too few", search.samples);
  LINKWRIGHT_REQUIRE(plan.closed_form() || plan.inputs() == 1,
                     "rest positions of groups without closed form need one input, not {}", plan.inputs());
  const bool rotary = plan.rotary[search.free];
  RestSearch asked = search;
  asked.range = between_stops(linkage, plan, search);
  const double reach = rotary ? pi : 4 * plan.size;
  const double from = asked.range ? (*asked.range)[0] : -reach, to = asked.range ? (*asked.range)[1] : reach;
  RestPositions out;
  if (!(from < to)) {
    out.status = Status::no_assembly;
    return out;
  }
  std::vector<InputRange> ranges;
  std::optional<LinkageAssembly> assembly;
  if (plan.closed_form()) {
    for (InputRange& r : input_limits(plan, search.inputs, static_cast<int>(search.free), from, to).ranges)
      ranges.push_back(std::move(r));
  } else {
    assembly.emplace(plan, InputReach{{from}, {to}});
    if (assembly->limits()) ranges = assembly->limits()->ranges;
  }
  StaticForces forces(linkage, plan, {search.free}, assembly ? &*assembly : nullptr);
  const std::vector<double> modes = forces.motion.modes;
  if (plan.closed_form() && !search.all_modes)
    std::erase_if(ranges, [&](const InputRange& r) {
      return !std::equal(r.modes.begin(), r.modes.end(), modes.begin(), modes.end());
    });
  if (ranges.empty()) out.status = Status::no_assembly;
  RestScan scan(linkage, plan, asked, forces);
  for (const InputRange& range : ranges) {
    if (context && (out.status = context->interruption()) != Status::done) return out;
    scan.run(range, out);
  }
  if (rotary && !asked.range)
    for (RestPosition& p : out.positions)
      if (out.ranges[p.range].full_turn) p.value = math::wrap_angle(p.value);
  return out;
}

std::vector<RestBand> rest_bands(const Linkage& linkage, const LinkagePlan& plan, const RestPositions& found,
                                 const RunContext* context) {
  HoldingForces holding(linkage, plan);
  LinkageMotion motion(plan);
  std::vector<InputMotion> inputs(1);
  const auto holds = [&](double value) {
    inputs[0].value = value;
    solve_position(plan, inputs, motion);
    if (motion.status != Status::done) return false;
    const HoldingRange drive = holding.range(value, motion, 0);
    return drive.status == Status::done && drive.least <= 0 && drive.greatest >= 0;
  };
  std::vector<RestBand> out;
  for (std::size_t r = 0; r < found.ranges.size(); ++r) {
    const RestRange& range = found.ranges[r];
    if (!range.modes.empty()) motion.modes = range.modes;
    std::vector<double> at = range.value;
    for (const RestPosition& p : found.positions)
      if (p.range == r) at.push_back(p.value);
    std::sort(at.begin(), at.end());
    bool held = false;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (context && context->interruption() != Status::done) return out;
      const bool now = holds(at[i]);
      if (now != held) {
        const bool begins = i == 0;
        const double edge = begins ? at[i]
                                   : math::bisect(holds, now ? at[i] : at[i - 1], now ? at[i - 1] : at[i],
                                                  {.relative = 1e-14})
                                         .inside;
        if (now)
          out.push_back({r, edge, edge});
        else
          out.back().to = edge;
      }
      if (now) out.back().to = at[i];
      held = now;
    }
  }
  return out;
}

std::vector<LoadPath> load_paths(const Linkage& linkage, const Linkage& unloaded, const LinkagePlan& plan,
                                 const RestSearch& search, const RestPositions& found) {
  std::optional<LinkageAssembly> assembly;
  if (!plan.closed_form() && !found.ranges.empty()) {
    const std::vector<double>& values = found.ranges.front().value;
    assembly.emplace(plan, InputReach{{values.front()}, {values.back()}});
  }
  LoadPathScan scan(linkage, unloaded, plan, search, assembly ? &*assembly : nullptr);
  std::vector<LoadPath> out;
  for (const RestRange& range : found.ranges) out.push_back(scan.run(range));
  return out;
}

}  // namespace linkwright::planar
