// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/scan.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"
#include "linkwright/planar/linkage/triangle.h"

namespace linkwright::planar {
namespace {

constexpr int nodes = 240;
constexpr double touching = 1e-11;

}  // namespace

GroupScan::GroupScan(const LinkagePlan& plan, std::span<const double> inputs, int input) : input_(at(input)) {
  LINKWRIGHT_REQUIRE(plan.closed_form(), "the plan has groups without closed form");
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs() && input >= 0 && at(input) < inputs.size(),
                     "the linkage has {} inputs, got {} and number {}", plan.inputs(), inputs.size(), input);
  for (double v : inputs) inputs_.push_back({v, 0, 0});
  inputs_[input_].rate = 1;
  levels_.reserve(plan.groups.size());
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    levels_.push_back(plan);
    levels_.back().groups.resize(k + 1);
    motions_.emplace_back(levels_.back());
  }
}

GroupScan::Closure GroupScan::closure(std::size_t k, double value) {
  const LinkagePlan& plan = levels_[k];
  LinkageMotion& m = motions_[k];
  inputs_[input_].value = value;
  solve_position(plan, inputs_, m);
  if (m.failed_group >= 0 && at(m.failed_group) < k) return {nan, nan, nan};
  // The groups before this one move, whether this one assembles or not.
  m.failed_group = static_cast<int>(k);
  solve_velocity(plan, inputs_, m);
  const Group& g = plan.groups[k];
  const PlanJoint &j1 = g.joints.front(), &j3 = g.joints.back();
  const PartState<double>&before = m.parts[at(j1.before.part)], &after = m.parts[at(j3.after.part)];
  const math::Vec2 a = point_on(before, j1.before.at), b = point_on(after, j3.after.at);
  const math::Vec2 d = b - a, slip = velocity_at(after, b) - velocity_at(before, a);
  const double length = norm(d);
  const auto dyad_closure = [&](const Dyad& dyad) -> Closure {
    switch (dyad.type) {
      case DyadType::rrr: {
        const double reach = dyad.first.length + dyad.second.length,
                     fold = std::abs(dyad.first.length - dyad.second.length), square = dot(d, d);
        return {(reach - length) * (reach + length) * (length - fold) * (length + fold),
                2 * dot(d, slip) * (reach * reach + fold * fold - 2 * square),
                std::min(std::abs(reach - length), std::abs(length - fold)) / reach};
      }
      case DyadType::rrp: {
        const math::Vec2 e = rotate(after.direction, j3.after.direction);
        // The line of the inner pin runs beside the slide's, by as much in every position of the guide.
        const double beside = rotate_inverse(j3.before.direction, dyad.second.vector).y;
        const double across = cross(e, d) + beside, l = dyad.first.length;
        const double slope = cross(e, slip) + after.speed * cross(perpendicular(e), d);
        return {(l - across) * (l + across), -2 * across * slope, std::abs(std::abs(across) - l) / l};
      }
      case DyadType::rpr: {
        const double offset = dyad.first.vector.y - dyad.second.vector.y;
        return {(length - offset) * (length + offset), 2 * dot(d, slip),
                std::abs(length - std::abs(offset)) / plan.size};
      }
      case DyadType::prp: {  // the sine between the slides, with sign
        const math::Vec2 e1 = rotate(before.direction, j1.before.direction),
                         e3 = rotate(after.direction, j3.after.direction);
        return {cross(e1, e3), (after.speed - before.speed) * dot(e1, e3), std::abs(cross(e1, e3))};
      }
      case DyadType::rpp:
        break;
    }
    return no_limit;
  };
  return by_kind(
      g, [](const Driver&) { return no_limit; }, [](const GearTrain&) { return no_limit; },
      [](const Follower&) { return no_limit; }, dyad_closure,
      [&](const Triangle& triangle) -> Closure {
        const InputMotion& drive = inputs_[at(g.joints[1].input)];
        const DrivenSide side = driven_side(g, drive.value);
        const double l1 = norm(side.way), reach = l1 + triangle.arm.length, fold = l1 - triangle.arm.length,
                     square = dot(d, d), longer = dot(side.way, side.rate) / l1 * drive.rate;
        return {(reach - length) * (reach + length) * (length - fold) * (length + fold),
                2 * dot(d, slip) * (reach * reach + fold * fold - 2 * square) +
                    2 * longer * (reach * (square - fold * fold) - fold * (reach * reach - square)),
                std::min(std::abs(reach - length), std::abs(length - std::abs(fold))) / reach};
      },
      [](const GeneralGroup&) { return no_limit; });
}

// A double zero at an end where the groups before may be singular themselves, so that it can only be looked
// at from inside: there the closure grows with the square of the distance.
bool GroupScan::touches_at_end(std::size_t k, double end, double inward) {
  double f[3];
  for (int i = 0; i < 3; ++i) f[i] = closure(k, end + inward * (i + 1)).value;
  if (!(f[0] > 0 && f[1] > 0 && f[2] > 0)) return false;
  const double ratio = f[1] / f[0], at_end = 3 * f[0] - 3 * f[1] + f[2];
  return ratio > 3 && ratio < 5 && std::abs(at_end) < 0.02 * f[0];
}

std::vector<Stretch> GroupScan::stretches(std::size_t k, std::span<const double> modes, double from,
                                          double to) {
  LINKWRIGHT_REQUIRE(k < levels_.size() && modes.size() == levels_.size(), "group {} of {}, {} modes", k,
                     levels_.size(), modes.size());
  LINKWRIGHT_REQUIRE(std::isfinite(from) && std::isfinite(to) && from < to, "no stretch: {} to {}", from, to);
  const GroupTraits traits = traits_of(levels_[k].groups[k]);
  if (!traits.has_limits) return {{from, to, EndKind::bound, EndKind::bound}};
  const bool slides_only = !traits.has_modes;  // the slides may become parallel
  for (std::size_t g = 0; g < k; ++g) motions_[k].modes[g] = modes[g];
  // The input runs as a cosine over the stretch: analytic also at limits of groups before, where positions
  // go with the square root of the distance.
  const double middle = (from + to) / 2, half = (to - from) / 2;
  const auto input_of = [&](double angle) { return middle - half * std::cos(angle); };
  struct Node {
    double at;
    Closure closure;
    bool touch = false;
  };
  std::vector<Node> found;
  const double inward = 1e-5 * (to - from);
  const bool touch_from = !slides_only && touches_at_end(k, from, inward),
             touch_to = !slides_only && touches_at_end(k, to, -inward);
  if (!touch_from) found.push_back({from, closure(k, from)});
  for (int i = 0; i < nodes; ++i) {
    const double x = input_of((i + 0.5) * pi / nodes);
    const Node next{x, closure(k, x)};
    if (!std::isfinite(next.closure.value)) continue;
    if (i > 0 && !found.empty() && !slides_only && std::isfinite(found.back().closure.slope) &&
        (found.back().closure.slope < 0) != (next.closure.slope < 0)) {
      const double s = math::zero_between([&](double v) { return closure(k, v).slope; }, found.back().at, x);
      const Closure here = closure(k, s);
      found.push_back({s, here, here.closeness < touching});
    }
    found.push_back(next);
  }
  if (!touch_to) found.push_back({to, closure(k, to)});
  std::erase_if(found, [](const Node& n) { return !std::isfinite(n.closure.value); });
  if (found.empty()) return {};

  std::vector<Stretch> out;
  Stretch open{from, to, touch_from ? EndKind::change_point : EndKind::bound, EndKind::bound};
  const auto inside = [&](double value) { return slides_only || value >= 0; };
  const auto close = [&](double x, EndKind kind) {
    open.to = x;
    open.to_kind = kind;
    if (open.to > open.from) out.push_back(open);
    open.from = x;
    open.from_kind = kind;
  };
  // Rounding at a bound where the group just closes.
  if (found.size() > 1 && found.front().at == from && found.front().closure.closeness < touching)
    found.front().closure.value = found[1].closure.value;
  if (found.size() > 1 && found.back().at == to && found.back().closure.closeness < touching)
    found.back().closure.value = found[found.size() - 2].closure.value;
  bool in = inside(found.front().closure.value);
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Node &last = found[i - 1], &next = found[i];
    if (next.touch) {
      // Before and after a touch the group assembles, or on neither side.
      if (in) close(next.at, EndKind::change_point);
      continue;
    }
    if (last.touch || (last.closure.value < 0) == (next.closure.value < 0)) continue;
    const double x = math::zero_between([&](double v) { return closure(k, v).value; }, last.at, next.at);
    if (slides_only) {
      close(x, EndKind::singular);
    } else if (in) {
      close(x, EndKind::limit);
      in = false;
    } else {
      open.from = x;
      open.from_kind = EndKind::limit;
      in = true;
    }
  }
  if (in) close(to, touch_to ? EndKind::change_point : EndKind::bound);
  return out;
}

bool periodic(const LinkagePlan& plan, int input) {
  if (!plan.rotary[at(input)]) return false;
  return std::all_of(plan.groups.begin(), plan.groups.end(), [&](const Group& g) {
    // A pinion that the input turns on and on moves its rack on.
    for (const PlanPair& pair : g.pairs) {
      const auto* cam = std::get_if<CamPair>(&pair.kind);
      for (const int part : parts_of(pair)) {
        const auto& turned = plan.turned[at(part)];
        if (part == 0 || !turned || !turned->shares.empty()) continue;
        const double gain = turned->gains[at(input)];
        // A cam that comes round comes back, and so does a slot.
        const bool comes_back = ((cam && !cam->is_sector) || std::holds_alternative<SlotPair>(pair.kind)) &&
                                std::abs(gain - std::round(gain)) < 1e-12;
        if (gain != 0 && !comes_back) return false;
      }
    }
    const GearTrain* train = g.as<GearTrain>();
    return !train || std::all_of(train->angles.begin(), train->angles.end(), [&](const DrivenAngle& a) {
      return a.turns == 1 && std::abs(a.gains[at(input)] - std::round(a.gains[at(input)])) < 1e-12;
    });
  });
}

}  // namespace linkwright::planar
