// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/detail/load_formula.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/smooth_branch.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

namespace linkwright::planar {
namespace {

// The motion ends when a group is so near to its dead point: the time left is then known to a millionth.
constexpr double dead_sine = 1e-3;
// From here on a group is watched for its dead point.
constexpr double watched_sine = 0.3;

}  // namespace

Simulation::Simulation(const Linkage& l, const LinkagePlan& plan, std::span<const InputDrive> drives,
                       const SimulationOptions& options, const SimulationOutput& output,
                       const SimulationWatch& watch)
    : l_(l),
      plan_(plan),
      drives_(drives),
      options_(options),
      output_(output),
      watch_(watch),
      dynamics_(l, plan, free_of(drives), cheaper_route(l, plan, count_free(drives))),
      inputs_(plan.inputs()),
      last_sines_(plan.groups.size(), 0.0) {
  for (std::size_t k = 0; k < drives.size(); ++k) {
    if (drives[k].law)
      laws_.push_back({k, math::MotionCurve(*drives[k].law)});
    else
      inputs_[k] = {drives[k].value, drives[k].rate, 0};
  }
  const auto free = dynamics_.free();
  LINKWRIGHT_REQUIRE(!free.empty(), "{} inputs, and none of them is free", drives.size());
  for (const std::size_t k : free)
    LINKWRIGHT_REQUIRE(std::isfinite(inputs_[k].value + inputs_[k].rate), "start {} with rate {}",
                       inputs_[k].value, inputs_[k].rate);
  friction_ = std::any_of(l.joints.begin(), l.joints.end(), has_friction);
  contacts_.resize(l.stops.size());
}

SimulationReport Simulation::run(std::span<const double> times, const RunContext* context) {
  breaks_ = breaks_of(l_, drives_, times.front(), times.back());
  span_ = times.back() - times.front();
  std::size_t kinks = 0;
  for_formulas(l_, [&kinks](const auto& load) {
    kinks = std::max(kinks, load.formula->first_kink + kinks_of(*load.formula));
  });
  kinks_of_loads_.assign(kinks, 1);
  if (!start(times.front())) return std::move(report_);
  std::vector<double> y = state();
  if (kinks > 0) take_branches(times.front(), y);
  if (!contacts_.empty() && !start_stops(times.front(), y)) return std::move(report_);
  std::vector<double> tolerances;
  const auto free = dynamics_.free();
  for (const std::span<const double> coarser : {options_.value_resolution, options_.rate_resolution})
    for (std::size_t i = 0; i < free.size(); ++i) {
      const double asked = options_.absolute_tolerance * (plan_.rotary[free[i]] ? 1 : plan_.size);
      tolerances.push_back(coarser.empty() ? asked : std::max(asked, coarser[i]));
    }
  tolerances.resize(y.size(), work_tolerance());
  std::vector<math::OdeEvent> events;
  if (stops_at_changes()) events.resize(2, {.crossing = math::OdeCrossing::falling});
  for (std::size_t i = 0; i < rubbing_.size(); ++i)
    events.resize(events.size() + 2, {.crossing = math::OdeCrossing::either});
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    events.push_back({.crossing = math::OdeCrossing::falling});
  events.resize(events.size() + kinks_of_loads_.size(), {.crossing = math::OdeCrossing::either});
  first_watched_ = events.size();
  events.resize(first_watched_ + watch_.count);
  watched_.assign(watch_.count, 1);

  math::OdeHooks hooks{.output_times = times, .context = context};
  hooks.output = [&](double t, std::span<const double> now) { return show(t, now); };
  hooks.step = [&](double t, std::span<const double> now) { return after_step(t, now); };
  if (!events.empty()) {
    hooks.events = events;
    hooks.event_values = [&](double t, std::span<const double> now, std::span<double> values) {
      std::size_t i = 0;
      if (stops_at_changes()) {
        values[i++] = std::min(now[0] - below_, 1.0);
        values[i++] = std::min(above_ - now[0], 1.0);
      }
      if (friction_) friction_values(t, now, values.subspan(i, 2 * rubbing_.size()));
      if (!contacts_.empty()) stop_values(t, now, values.subspan(first_stop_event(), contacts_.size()));
      if (!kinks_of_loads_.empty())
        kink_values(t, now, values.subspan(first_kink_event(), kinks_of_loads_.size()));
      // Beyond what can be placed they stay what they were.
      if (watch_.count > 0 && watched(t, now).status == Status::done) watch_.values(instant_, watched_);
      std::copy(watched_.begin(), watched_.end(),
                values.begin() + static_cast<std::ptrdiff_t>(first_watched_));
    };
    hooks.event = [&](double t, std::span<const std::size_t> which, std::span<double> now) {
      return act(t, which, now);
    };
  }
  if ((friction_ || !contacts_.empty()) && options_.method != math::OdeMethod::adams)
    hooks.project = [&](double t, std::span<double> now) {
      if (any_sticks()) still(t, now);
      if (any_closed()) hold_on_stops(t, now);
      return true;
    };
  if (stuck_) {  // from the start on
    show(times.front(), y);
    finish({.t = times.front()}, y);
    return std::move(report_);
  }
  const math::OdeReport ode = integrate_by_pieces(
      [&](double t, std::span<const double> now, std::span<double> rate) { return slope(t, now, rate); }, y,
      times.front(), times.back(), breaks_,
      {.method = options_.method,
       .relative_tolerance = options_.relative_tolerance,
       .absolute_tolerances = tolerances,
       .max_steps = options_.max_steps},
      hooks);
  finish(ode, y);
  return std::move(report_);
}

std::vector<double> Simulation::state() const {
  std::vector<double> y;
  for (const std::size_t k : dynamics_.free()) y.push_back(inputs_[k].value);
  for (const std::size_t k : dynamics_.free()) y.push_back(inputs_[k].rate);
  y.push_back(0);
  if (friction_) y.push_back(0);
  return y;
}

void Simulation::put(double t, std::span<const double> y) {
  const auto free = dynamics_.free();
  for (std::size_t i = 0; i < free.size(); ++i) inputs_[free[i]] = {y[i], y[free.size() + i], 0};
  for (const auto& [k, curve] : laws_) {
    const math::Motion m = curve(t);
    inputs_[k] = {m.value, m.rate, m.acceleration};
  }
}

double Simulation::work_tolerance() const {
  double scale = start_kinetic_;
  for (const PartMass& m : plan_.masses) scale += m.mass * std::abs(l_.gravity) * plan_.size;
  for (const LinearSpring& s : l_.springs) scale += s.stiffness * plan_.size * plan_.size / 100;
  for (const Strut& s : l_.struts)
    if (s.gas) scale += s.gas->extended_force * s.gas->stroke;
  return scale > 0 ? options_.relative_tolerance * scale : 1e30;
}

Simulation::Answer Simulation::solve(double t) {
  if (!branch_) {
    const Status status = solve_pressed(t);
    return {status == Status::done && changed_side() ? Status::branch_lost : status, dynamics_.power,
            first_inertia(), dynamics_.friction_power};
  }
  const double value = inputs_[0].value;
  if (branch_->has_change_points()) {
    const SmoothBranch::Near near = branch_->nearest(value);
    const double x = (value - near.value) / branch_->half_width();
    if (std::abs(x) < 1 && !any_closed()) return interpolated(t, near.value, x);
    branch_->set_modes(value, dynamics_.motion);
  }
  const Status status = solve_pressed(t);
  return {status, dynamics_.power, first_inertia(), dynamics_.friction_power};
}

bool Simulation::slope(double t, std::span<const double> y, std::span<double> rate) {
  if (t > horizon_) return false;
  put(t, y);
  const Answer answer = solve(t);
  last_status_ = answer.status;
  if (answer.status != Status::done) {
    failed_group_ = dynamics_.motion.failed_group;
    restore();
    return false;
  }
  if (friction_) still_inputs();
  const auto free = dynamics_.free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    rate[i] = inputs_[free[i]].rate;
    rate[free.size() + i] = inputs_[free[i]].acceleration;
  }
  rate[2 * free.size()] = answer.power;
  if (friction_) rate[2 * free.size() + 1] = answer.friction_power;
  return true;
}

bool Simulation::changed_side() const {
  for (std::size_t g = 0; g < plan_.groups.size(); ++g)
    if (!traits_of(plan_.groups[g]).closed_form && last_sines_[g] * dynamics_.motion.groups[g].sine < 0)
      return true;
  return false;
}

void Simulation::remember() {
  for (std::size_t g = 0; g < plan_.groups.size(); ++g) last_sines_[g] = dynamics_.motion.groups[g].sine;
  if (!plan_.closed_form()) good_parts_ = dynamics_.motion.parts;
}

void Simulation::restore() {
  if (!good_parts_.empty()) dynamics_.motion.parts = good_parts_;
}

bool Simulation::start(double t) {
  put(t, state());
  report_.time = t;
  dynamics_.motion.groups.assign(plan_.groups.size(), {});
  const bool limits = std::any_of(plan_.groups.begin(), plan_.groups.end(),
                                  [](const Group& g) { return traits_of(g).has_limits; });
  if (plan_.inputs() == 1 && plan_.closed_form() && limits) {
    branch_.emplace(plan_, inputs_[0].value, dynamics_.motion.modes);
    if (branch_->path().status != Status::done) branch_.reset();
  }
  if (!plan_.closed_form()) {
    // The mode that the drawing shows, wherever the motion starts.
    InputReach reach;
    for (const InputMotion& i : inputs_) reach.low.push_back(i.value), reach.high.push_back(i.value);
    LinkageAssembly(plan_, reach, AtChangePoint::stop).place(inputs_, dynamics_.motion);
    if (dynamics_.motion.status != Status::done) {
      report_.status = dynamics_.motion.status;
      report_.group = dynamics_.motion.failed_group;
      report_.message = start_message(report_.status, t);
      return false;
    }
  }
  if (friction_ && !start_friction(t)) return false;
  const Answer answer = solve(t);
  if (answer.status != Status::done) {
    report_.status = answer.status;
    report_.group = dynamics_.motion.failed_group;
    report_.message = start_message(answer.status, t);
    return false;
  }
  remember();
  neighbours(inputs_[0].value);
  const LinkageMotion& m = placed();
  start_kinetic_ = kinetic(answer.inertia);
  start_potential_ = potential_energy(l_, plan_, m);
  for (std::size_t k = 0; k < l_.torsion_springs.size(); ++k) twists_.push_back({m.twists[k], nan, 0});
  twists_ = audited_twists(t);
  twists_at_ = t;
  last_time_ = t;
  last_ = inputs_[0];
  return true;
}

const LinkageMotion& Simulation::placed() {
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_motion(plan_, inputs_, dynamics_.motion);
  return dynamics_.motion;
}

double Simulation::kinetic(double inertia) const {
  if (plan_.inputs() == 1) return inertia * inputs_[0].rate * inputs_[0].rate / 2;
  return kinetic_energy(plan_, dynamics_.motion);
}

bool Simulation::show(double t, std::span<const double> y) {
  put(t, y);
  const Answer answer = solve(t);
  if (answer.status != Status::done) return true;  // beyond what the step hook will end
  SimulationInstant now{.time = t, .inputs = inputs_};
  if (any_sticks()) now.held = forces_with_friction(t);
  if (friction_) {
    still_inputs();
    now.friction_loss = y.back();
    now.friction_senses = dynamics_.states->senses;
  }
  const LinkageMotion& motion = placed();
  now.status = motion.status, now.inputs = inputs_, now.motion = &motion;
  now.kinetic = kinetic(answer.inertia);
  now.work = y[2 * dynamics_.free().size()] + kinks_;
  if (motion.status == Status::done || motion.status == Status::singular) {
    now.potential = motion.status == Status::done ? audited_potential(t) : interpolated_potential();
    now.drift = (now.kinetic - start_kinetic_) + (now.potential - start_potential_) - now.work;
    report_.largest_drift = std::max(report_.largest_drift, std::abs(now.drift));
    report_.peak_energy = std::max(
        {report_.peak_energy, now.kinetic, std::abs(now.potential - start_potential_), std::abs(now.work)});
  }
  report_.time = t;
  return !output_ || output_(now);
}

std::vector<Simulation::AuditedTwist> Simulation::audited_twists(double t) const {
  std::vector<AuditedTwist> out = twists_;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const TorsionSpring& s = l_.torsion_springs[k];
    const PartState<double> first = body_state(plan_, dynamics_.motion, s.first),
                            second = body_state(plan_, dynamics_.motion, s.second);
    const double angle = angle_of(second.direction) - angle_of(first.direction),
                 rate = second.speed - first.speed;
    AuditedTwist& now = out[k];
    const double turned = std::isnan(now.angle) ? 0 : angle - now.angle,
                 expected = (now.rate + rate) / 2 * (t - twists_at_);
    now = {now.twist + turned + full_turn * std::round((expected - turned) / full_turn), angle, rate};
  }
  return out;
}

double Simulation::audited_potential(double t) const {
  std::vector<double> twists;
  for (const AuditedTwist& now : audited_twists(t)) twists.push_back(now.twist);
  return potential_energy(l_, plan_, dynamics_.motion, twists);
}

const SimulationInstant& Simulation::watched(double t, std::span<const double> y) {
  put(t, y);
  instant_ = {.time = t,
              .status = solve(t).status,
              .inputs = inputs_,
              .work = y[2 * dynamics_.free().size()] + kinks_};
  if (instant_.status == Status::done) {
    if (any_sticks()) instant_.held = forces_with_friction(t);
    instant_.motion = &placed();
    instant_.status = instant_.motion->status;
  }
  if (instant_.status != Status::done) restore();
  return instant_;
}

bool Simulation::after_step(double t, std::span<const double> y) {
  if (watch_.note && watched(t, y).status == Status::done && !watch_.note(instant_, {})) return false;
  // What an event has missed, such as two crossings in one step, is taken up here.
  if (!dynamics_.motion.branches.empty() && branches_at(t, y) != dynamics_.motion.branches)
    take_branches(t, y);
  put(t, y);
  if (!twists_.empty() && solve(t).status == Status::done && placed().status == Status::done) {
    twists_ = audited_twists(t);
    twists_at_ = t;
  }
  const double time_before = last_time_;
  const InputMotion before = last_;
  last_time_ = t;
  last_ = inputs_[0];
  report_.time = t;
  if (friction_ && jams(t)) return false;
  if (branch_ && branch_->path().period > 0) {
    note_passages(time_before, before);
    return true;
  }
  if (branch_) note_passages(time_before, before);
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_position(plan_, inputs_, dynamics_.motion);
  if (dynamics_.motion.status != Status::done) return true;
  const bool going_on = clear_of_limits(t, t - time_before);
  remember();
  return going_on;
}

bool Simulation::clear_of_limits(double t, double step) {
  horizon_ = infinity;
  if (step <= 0) return true;
  for (std::size_t g = 0; g < plan_.groups.size(); ++g) {
    const GroupTraits traits = traits_of(plan_.groups[g]);
    if (!traits.closes_loop || !traits.closed_form) continue;
    if (branch_ && !ends_here(static_cast<int>(g))) continue;
    const double sine = std::abs(dynamics_.motion.groups[g].sine), before = std::abs(last_sines_[g]);
    if (sine > watched_sine || sine >= before) continue;
    const double left = sine * step / (before - sine);
    if (sine < dead_sine) {
      limit_time_ = t + left;
      report_.group = static_cast<int>(g);
      at_limit_ = true;
      return false;
    }
    horizon_ = std::min(horizon_, t + 0.95 * left);
  }
  return true;
}

bool Simulation::ends_here(int group) const {
  const RangeEnd& end = nearer_end();
  if (end.kind != EndKind::limit && end.kind != EndKind::singular) return false;
  if (std::find(end.groups.begin(), end.groups.end(), group) == end.groups.end()) return false;
  return std::abs(inputs_[0].value - end.value) <
         std::abs(inputs_[0].value - branch_->nearest(inputs_[0].value).value);
}

const RangeEnd& Simulation::nearer_end() const {
  const BranchPath& path = branch_->path();
  const double value = inputs_[0].value;
  return value - path.low.value < path.high.value - value ? path.low : path.high;
}

math::OdeAction Simulation::act(double t, std::span<const std::size_t> which, std::span<double> y) {
  math::OdeAction action = math::OdeAction::go_on;
  if (watch_.note && which.back() >= first_watched_) {
    std::vector<std::size_t> crossed;
    for (const std::size_t event : which)
      if (event >= first_watched_) crossed.push_back(event - first_watched_);
    if (watched(t, y).status == Status::done && !watch_.note(instant_, crossed)) return math::OdeAction::stop;
  }
  std::vector<std::size_t> rubbed;
  for (const std::size_t event : which)
    if (event >= first_friction_event() && event < first_stop_event())
      rubbed.push_back(event - first_friction_event());
  std::vector<std::size_t> met;
  for (const std::size_t event : which)
    if (event >= first_stop_event() && event < first_kink_event()) met.push_back(event - first_stop_event());
  if (!rubbed.empty()) action = friction_event(t, rubbed, y);
  if (action == math::OdeAction::stop) return action;
  if (!met.empty()) action = stop_event(t, met, y);
  if (action == math::OdeAction::stop) return action;
  if (action == math::OdeAction::go_on && std::any_of(which.begin(), which.end(), [this](std::size_t event) {
        return event >= first_kink_event() && event < first_watched_;
      }))
    action = kink_event(t, y);
  for (const std::size_t event : which) {
    if (event >= first_friction_event()) continue;
    const double value = event == 0 ? below_ : above_, sense = event == 0 ? -1 : 1;
    const SmoothBranch::Near here = branch_->nearest(value);
    if (options_.at_change_point == AtChangePoint::stop) {
      note_passage({t, value, here.end->groups, 0});
      report_.group = here.end->groups.empty() ? -1 : here.end->groups.front();
      at_change_ = true;
      return math::OdeAction::stop;
    }
    const std::vector<int> groups = here.end->groups;
    const std::optional<double> lost = kink(value, sense, y[1]);
    note_passage({t, value, groups, lost.value_or(0)});
    if (!lost) {
      report_.group = groups.empty() ? -1 : groups.front();
      at_change_ = true;
      return math::OdeAction::stop;
    }
    kinks_ -= *lost;
    // The impact may throw the linkage back: it leaves along the new branch to either side. The event
    // leaves the input within rounding of the change point; only a return beyond that is another passage.
    const double way = y[1] >= 0 ? 1 : -1;
    neighbours(value + way * branch_->half_width() / 2);
    (way > 0 ? below_ : above_) = value - way * 1e-9;
    action = math::OdeAction::restart;
  }
  return action;
}

void Simulation::kink_values(double t, std::span<const double> y, std::span<double> values) {
  // Where the linkage is not known they stay what they were.
  if (place_at(t, y, false)) {
    for_formulas(l_, [&](const auto& load) {
      const LoadFormula& f = *load.formula;
      find_kinks(f, l_, plan_, dynamics_.motion, t,
                 std::span(kinks_of_loads_).subspan(f.first_kink, kinks_of(f)));
    });
  }
  std::copy(kinks_of_loads_.begin(), kinks_of_loads_.end(), values.begin());
}

std::vector<double> Simulation::branches_at(double t, std::span<const double> y) {
  std::vector<double> out(kinks_of_loads_.size());
  if (!place_at(t, y, false)) return dynamics_.motion.branches;
  for_formulas(l_, [&](const auto& load) {
    const LoadFormula& f = *load.formula;
    find_branches(f, l_, plan_, dynamics_.motion, t, std::span(out).subspan(f.first_kink, kinks_of(f)));
  });
  return out;
}

void Simulation::take_branches(double t, std::span<const double> y) {
  // Just on a bend, the way of the motion says on which side it goes on.
  constexpr double ahead = 1e-9;
  std::vector<double> now = branches_at(t, y), later(y.begin(), y.end());
  const std::size_t n = dynamics_.free().size();
  for (std::size_t i = 0; i < n; ++i) later[i] += ahead * span_ * y[n + i];
  const std::vector<double> then = branches_at(t + ahead * span_, later);
  for (std::size_t k = 0; k < now.size(); ++k)
    if (now[k] == 0 && k < then.size()) now[k] = then[k];
  dynamics_.motion.branches = std::move(now);
  put(t, y);
}

// Steps stay on the branches of the formulas; behind a jump or a bend they begin anew on others. A formula
// that throws the motion back at once is left to the steps themselves.
math::OdeAction Simulation::kink_event(double t, std::span<const double> y) {
  constexpr int most_at_once = 20;
  constexpr double at_once = 1e-9;
  if (dynamics_.motion.branches.empty()) return math::OdeAction::go_on;
  kinks_at_once_ = t - kinked_at_ <= at_once * span_ ? kinks_at_once_ + 1 : 0;
  kinked_at_ = t;
  if (kinks_at_once_ < most_at_once)
    take_branches(t, y);
  else
    dynamics_.motion.branches.clear();
  return math::OdeAction::restart;
}

std::vector<double> breaks_of(const Linkage& linkage, std::span<const InputDrive> drives, double from,
                              double to) {
  std::vector<double> out;
  const auto corners = [&](const LoadFactor& f) {
    if (f.against != LoadArgument::time) return;
    for (const double t : f.argument)
      if (t > from && t < to) out.push_back(t);
  };
  for (const InputDrive& c : drives)
    if (c.law) {
      const std::vector<double> own = math::breaks(*c.law, from, to);
      out.insert(out.end(), own.begin(), own.end());
    }
  for (const PointForce& f : linkage.forces) corners(f.factor);
  for (const BodyTorque& t : linkage.torques) corners(t.factor);
  for (const Strut& s : linkage.struts) corners(s.factor);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

math::OdeReport integrate_by_pieces(math::OdeFunction f, std::span<double> y, double from, double to,
                                    std::span<const double> breaks, math::OdeOptions options,
                                    math::OdeHooks hooks) {
  math::OdeWorkspace workspace;
  math::OdeReport sum;
  const std::span<const double> outputs = hooks.output_times;
  const auto output = hooks.output;
  for (std::size_t i = 0; i <= breaks.size(); ++i) {
    const bool last = i == breaks.size();
    const double begin = i == 0 ? from : breaks[i - 1], end = last ? to : breaks[i];
    // Laws are asked on this side of the breaks.
    const double low = i == 0 ? begin : std::nextafter(begin, infinity),
                 high = last ? end : std::nextafter(end, -infinity);
    const auto first = std::lower_bound(outputs.begin(), outputs.end(), begin),
               beyond = last ? outputs.end() : std::lower_bound(outputs.begin(), outputs.end(), end);
    hooks.output_times = std::span(first, beyond);
    hooks.output = first == beyond ? nullptr : output;
    const auto inside = [&](double t, std::span<const double> now, std::span<double> rate) {
      return f(std::clamp(t, low, high), now, rate);
    };
    const math::OdeReport piece = math::integrate(inside, y, begin, end, options, hooks, workspace);
    const long steps = sum.steps + piece.steps, evaluations = sum.evaluations + piece.evaluations;
    sum = piece;
    sum.steps = steps;
    sum.evaluations = evaluations;
    if (piece.end != math::OdeEnd::time) break;
    options.max_steps = std::max(1L, options.max_steps - piece.steps);
  }
  return sum;
}

void solve_forces(const Linkage& linkage, const LinkagePlan& plan, const SimulationInstant& instant,
                  LinkageForces& forces) {
  if (instant.held)
    forces = *instant.held;
  else
    solve_forces(linkage, plan, *instant.motion, instant.time, instant.inputs[0].value, forces);
}

SimulationReport simulate_watched(const Linkage& linkage, const LinkagePlan& plan,
                                  std::span<const InputDrive> drives, std::span<const double> times,
                                  const SimulationOptions& options, const SimulationOutput& output,
                                  const SimulationWatch& watch, const RunContext* context) {
  LINKWRIGHT_REQUIRE(drives.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     drives.size());
  LINKWRIGHT_REQUIRE(times.size() >= 2 && times.front() < times.back(), "no interval of time: {} times",
                     times.size());
  return Simulation(linkage, plan, drives, options, output, watch).run(times, context);
}

SimulationReport simulate(const Linkage& linkage, const LinkagePlan& plan, std::span<const InputDrive> drives,
                          std::span<const double> times, const SimulationOptions& options,
                          const SimulationOutput& output, const RunContext* context) {
  return simulate_watched(linkage, plan, drives, times, options, output, {}, context);
}

}  // namespace linkwright::planar
