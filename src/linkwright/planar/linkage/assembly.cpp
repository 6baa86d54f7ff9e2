// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/assembly.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/detail/joint_rows.h"
#include "linkwright/planar/linkage/modes.h"
#include "linkwright/planar/linkage/scan.h"

namespace linkwright::planar {
namespace {

constexpr int places = 64;  // within the reach of the input at which poses of unknown inputs are compared
constexpr int steps_of_a_range = 720;  // from one end of what is asked for to the other
constexpr std::size_t max_pairs = 6;   // groups whose modes are all listed

std::vector<InputMotion> standing(std::span<const double> values) {
  std::vector<InputMotion> out;
  for (const double v : values) out.push_back({v, 0, 0});
  return out;
}

// The value nearest to `start` at which a linkage in closed form assembles in its modes.
std::optional<double> nearest_assembled(const LinkagePlan& plan, std::span<const double> modes, double start,
                                        double from, double to) {
  const auto pairs = std::count_if(plan.groups.begin(), plan.groups.end(),
                                   [](const Group& g) { return traits_of(g).has_modes; });
  if (static_cast<std::size_t>(pairs) > max_pairs) return std::nullopt;
  if (periodic(plan, 0)) from = start - pi, to = start + pi;
  const InputLimits limits = input_limits(plan, std::span(&start, 1), 0, from, to);
  std::optional<double> best;
  double least = infinity;
  for (const InputRange& r : limits.ranges) {
    if (!std::equal(modes.begin(), modes.end(), r.modes.begin(), r.modes.end())) continue;
    for (const double turn : {0.0, limits.closed ? -full_turn : 0.0}) {
      const double low = r.from.value + turn, high = r.to.value + turn,
                   apart = std::max({low - start, start - high, 0.0});
      // If two ranges are equally near, as in a symmetric linkage, the one ahead counts.
      const bool as_near = std::abs(apart - least) <= 1e-9 * (to - from);
      if (as_near ? low < start : apart > least) continue;
      least = apart;
      best = std::midpoint(low, high);
    }
  }
  return best;
}

// The last value from the drawing towards `end` that is reached in steps; `step` as large as one is at most.
RangeEnd reached(const LinkagePlan& plan, LinkageAssembly& assembly, double start, double end, double step) {
  LinkageMotion motion(plan);
  const auto assembles = [&](double value) {
    assembly.place(standing(std::span(&value, 1)), motion);
    return motion.status == Status::done;
  };
  const int steps = static_cast<int>(std::ceil(std::abs(end - start) / step));
  double good = start;
  for (int i = 1; i <= steps; ++i) {
    double bad = start + (end - start) * i / steps;
    if (assembles(bad)) {
      good = bad;
      continue;
    }
    for (int halvings = 0; halvings < 52; ++halvings) {
      const double middle = std::midpoint(good, bad);
      (assembles(middle) ? good : bad) = middle;
    }
    return {good, EndKind::limit, {}};
  }
  return {end, EndKind::bound, {}};
}

}  // namespace

InputReach reach_of(std::span<const std::vector<InputMotion>> rows) {
  InputReach out;
  for (const std::vector<InputMotion>& row : rows) {
    if (out.low.empty())
      for (const InputMotion& i : row) out.low.push_back(i.value), out.high.push_back(i.value);
    for (std::size_t i = 0; i < row.size(); ++i) {
      out.low[i] = std::min(out.low[i], row[i].value);
      out.high[i] = std::max(out.high[i], row[i].value);
    }
  }
  return out;
}

LinkageAssembly::LinkageAssembly(const LinkagePlan& plan, const InputReach& reach, AtChangePoint policy,
                                 bool in_sequence, std::span<const double> modes)
    : plan_(plan), in_sequence_(in_sequence), modes_(modes.begin(), modes.end()) {
  LINKWRIGHT_REQUIRE(reach.low.size() == plan.inputs() && reach.high.size() == plan.inputs(),
                     "the linkage has {} inputs, got {}", plan.inputs(), reach.low.size());
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    if (!plan.groups[k].as<GeneralGroup>()) continue;
    if (closed_) first_general_ = k;
    last_general_ = k;
    closed_ = false;
  }
  if (closed_) return;
  if (modes_.empty()) modes_ = LinkageMotion(plan).modes;
  before_ = plan;
  before_.groups.resize(first_general_);
  find(reach);
  if (found_ && plan.inputs() == 1) follow_one(reach, policy);
}

// True if the groups without closed form have their positions.
bool LinkageAssembly::assembled(const LinkageMotion& m) const {
  return m.failed_group < 0 || at(m.failed_group) > last_general_;
}

bool LinkageAssembly::try_at(std::span<const double> inputs, std::span<const double> modes) {
  LinkageMotion motion(plan_);
  motion.modes.assign(modes.begin(), modes.end());
  solve_position(plan_, standing(inputs), motion);
  if (!assembled(motion)) return false;
  anchor_.assign(inputs.begin(), inputs.end());
  parts_ = motion.parts;
  return found_ = true;
}

// The start poses are moved onto the joints, the input with them.
bool LinkageAssembly::try_near(std::span<const double> inputs) {
  LinkageMotion motion(plan_);
  motion.modes = modes_;
  solve_position(before_, standing(inputs), motion);
  if (motion.status != Status::done) return false;
  double value = inputs[0];
  if (!nearest_place(plan_, along_input(inputs, 0), value, motion.parts)) return false;
  anchor_ = {value};
  parts_ = motion.parts;
  return found_ = true;
}

// The distance of the start poses of the first general group from closure.
double LinkageAssembly::misfit(std::span<const double> inputs) {
  LinkageMotion motion(plan_);
  motion.modes = modes_;
  const std::vector<InputMotion> now = standing(inputs);
  solve_position(before_, now, motion);
  if (motion.status != Status::done) return infinity;
  const Group& g = plan_.groups[first_general_];
  double sum = 0;
  for (const PlanJoint& j : g.joints) {
    const InputMotion* input = j.input >= 0 ? &now[at(j.input)] : nullptr;
    const JointRows r = joint_rows(j, input != nullptr, motion.parts);
    const auto f = joint_residuals(j, r, input, motion.parts, plan_.size);
    for (int e = 0; e < r.count; ++e) sum += f[at(e)] * f[at(e)];
  }
  return sum;
}

void LinkageAssembly::find(const InputReach& reach) {
  const bool one = plan_.inputs() == 1;
  const bool poses = !plan_.groups[first_general_].as<GeneralGroup>()->start.empty();
  if (!plan_.drawn_inputs.empty() && poses) {
    std::vector<double> drawn = plan_.drawn_inputs;
    // The poses show angles but for whole turns: the ones nearest to where the inputs go.
    for (std::size_t i = 0; i < drawn.size(); ++i)
      if (plan_.rotary[i])
        drawn[i] += full_turn * std::round(((reach.low[i] + reach.high[i]) / 2 - drawn[i]) / full_turn);
    if (try_at(drawn, modes_) || (one && try_near(drawn))) return;
  }
  struct Candidate {
    std::vector<double> inputs;
    double misfit;
  };
  std::vector<Candidate> candidates;
  for (int i = 0; i <= places; ++i) {
    std::vector<double> inputs;
    for (std::size_t k = 0; k < reach.low.size(); ++k)
      inputs.push_back(i == places ? reach.high[k]
                                   : reach.low[k] + (reach.high[k] - reach.low[k]) * i / places);
    candidates.push_back({inputs, poses ? misfit(inputs) : 0.0});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
  for (const Candidate& c : candidates)
    if (try_at(c.inputs, modes_)) return;
  for (const double share : {0.0, 0.5, 1.0, 0.25, 0.75}) {
    std::vector<double> inputs;
    for (std::size_t k = 0; k < reach.low.size(); ++k)
      inputs.push_back(reach.low[k] + share * (reach.high[k] - reach.low[k]));
    const AssemblyModes modes = assembly_modes(plan_, inputs);
    if (modes.found.empty()) continue;
    anchor_ = inputs;
    parts_ = modes.found.front().parts;
    found_ = true;
    return;
  }
}

void LinkageAssembly::follow_one(const InputReach& reach, AtChangePoint policy) {
  const bool turns = periodic(plan_, 0);
  const double start = anchor_[0], around = turns ? full_turn : 0;
  // On a line of no length a mode has no range.
  const double width = reach.high[0] > reach.low[0] ? 0 : plan_.rotary[0] ? 1e-3 : 1e-3 * plan_.size;
  const double low = std::min(reach.low[0], start) - std::max(around, width),
               high = std::max(reach.high[0], start) + std::max(around, width);
  curve_.emplace(plan_, along_input(anchor_, 0), start, parts_, turns ? low : std::min(reach.low[0], start),
                 turns ? high : std::max(reach.high[0], start + width), around, policy);
  InputLimits limits;
  limits.rotary = plan_.rotary[0];
  limits.closed = turns;
  limits.from = turns ? -pi : std::min(reach.low[0], start);
  limits.to = turns ? pi : std::max(reach.high[0], start);
  InputRange range{curve_->low(), curve_->high(), curve_->period() > 0, modes_, 1};
  if (turns && !range.full_turn) {
    const double shift = full_turn * std::floor((range.from.value + pi) / full_turn);
    range.from.value -= shift;
    range.to.value -= shift;
  }
  limits.ranges.push_back(std::move(range));
  limits.circuits = 1;
  limits_ = std::move(limits);
}

// Along a straight line of inputs from a place; false where the mode ends before.
bool LinkageAssembly::go(std::span<const double> from, std::span<const PartState<double>> parts,
                         std::span<const double> to, LinkageMotion& motion) {
  if (std::equal(from.begin(), from.end(), to.begin())) {
    for (std::size_t p = 1; p < parts.size(); ++p)
      motion.parts[p].origin = parts[p].origin, motion.parts[p].direction = parts[p].direction;
    return true;
  }
  ModeCurve curve(plan_, line_between(from, to), 0, parts, 0, 1);
  if (curve.high().kind == EndKind::bound) return curve.place(1, motion) == Status::done;
  gap_ = curve.gap(1);
  return false;
}

bool LinkageAssembly::reach_out(std::span<const double> to, LinkageMotion& motion) {
  if (in_sequence_ && !last_.empty() && go(last_, last_parts_, to, motion)) return true;
  if (go(anchor_, parts_, to, motion)) return true;
  const double gap = gap_;
  for (const bool backwards : {false, true}) {
    std::vector<double> here = anchor_;
    std::vector<PartState<double>> parts = parts_;
    bool on_the_way = true;
    for (std::size_t i = 0; i < to.size() && on_the_way; ++i) {
      const std::size_t k = backwards ? to.size() - 1 - i : i;
      std::vector<double> next = here;
      next[k] = to[k];
      on_the_way = go(here, parts, next, motion);
      here = std::move(next);
      parts = motion.parts;
    }
    if (on_the_way) return true;
  }
  gap_ = gap;
  return false;
}

void LinkageAssembly::leave_open(std::span<const InputMotion> inputs, Status status, double gap,
                                 LinkageMotion& motion) {
  motion.modes = modes_;
  solve_position(before_, inputs, motion);
  if (motion.status == Status::done) {
    motion.gap = status == Status::no_assembly && std::isfinite(gap) ? gap : 0;
    mark_failed(plan_, motion, first_general_, status);
  } else {
    mark_failed(plan_, motion, at(motion.failed_group), motion.status);
  }
}

void LinkageAssembly::place(std::span<const InputMotion> inputs, LinkageMotion& motion) {
  if (closed_) return solve_position(plan_, inputs, motion);
  if (!found_) return leave_open(inputs, Status::no_assembly, 0, motion);
  motion.modes = modes_;
  Status status = Status::done;
  if (curve_) {
    status = curve_->place(inputs[0].value, motion);
    if (status != Status::done) gap_ = curve_->gap(inputs[0].value);
  } else {
    std::vector<double> to;
    for (const InputMotion& i : inputs) to.push_back(i.value);
    if (!reach_out(to, motion)) status = Status::no_assembly;
    if (status == Status::done) last_ = std::move(to), last_parts_ = motion.parts;
  }
  if (status != Status::done) return leave_open(inputs, status, gap_, motion);
  solve_position(plan_, inputs, motion);
  // The curve has a place here: where Newton's method does not converge, there is a dead point.
  if (motion.status == Status::not_converged) motion.status = Status::singular;
}

std::optional<InputRange> assembled_range(const LinkagePlan& plan, double from, double to,
                                          AtChangePoint policy) {
  LINKWRIGHT_REQUIRE(plan.inputs() == 1, "the linkage has {} inputs, one is needed", plan.inputs());
  LINKWRIGHT_REQUIRE(from < to, "no interval: {} to {}", from, to);
  const std::vector<double> modes = LinkageMotion(plan).modes;
  if (!plan.closed_form()) {
    LinkageAssembly assembly(plan, {{from}, {to}}, policy);
    if (!assembly.found()) return std::nullopt;
    const double start = assembly.drawn_inputs()[0], step = (to - from) / steps_of_a_range;
    const double period = assembly.curve() ? assembly.curve()->period() : 0;
    InputRange out{{start, EndKind::bound, {}}, {start, EndKind::bound, {}}, false, modes, 1};
    out.to = reached(plan, assembly, start, period > 0 ? start + period : std::max(start, to), step);
    out.full_turn = period > 0 && out.to.kind == EndKind::bound;
    if (!out.full_turn)
      out.from = reached(plan, assembly, start, period > 0 ? start - period : std::min(start, from), step);
    return out;
  }
  double start = plan.drawn_inputs.empty() ? 0 : plan.drawn_inputs[0];
  if (!(from <= start && start <= to)) start = std::abs(start - from) <= std::abs(start - to) ? from : to;
  const auto follow = [&] {
    return branch_path(plan, std::span(&start, 1), 0, modes, std::min(from, start), std::max(to, start),
                       policy);
  };
  BranchPath path = follow();
  if (path.status != Status::done || !(path.low.value < path.high.value)) {
    const auto nearest = nearest_assembled(plan, modes, start, from, to);
    if (!nearest) return std::nullopt;
    start = *nearest;
    path = follow();
    if (path.status != Status::done) return std::nullopt;
  }
  if (path.period > 0)
    return InputRange{{start, EndKind::bound, {}}, {start + path.period, EndKind::bound, {}}, true, modes, 1};
  return InputRange{path.low, path.high, false, modes, 1};
}

}  // namespace linkwright::planar
