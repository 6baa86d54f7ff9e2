#include "linkwright/planar/simulation/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/smooth_branch.h"

namespace linkwright::planar {
namespace {

// The motion ends when a group is so near to its dead point: the time left is then known to a millionth.
constexpr double dead_sine = 1e-3;
// From here on a group is watched for its dead point.
constexpr double watched_sine = 0.3;
// Friction chatters when a joint turns round in a tenth of so many steps, and these take so small a share of
// the time.
constexpr long chatter_steps = 100;
constexpr double chatter_share = 1e-5;

constexpr std::string_view jams = "it jams, for no finite joint forces go with motion in this sense";

std::string place(const Linkage& l, const LinkagePlan& plan, std::size_t input, double value) {
  const std::string& name = l.joints[at(l.driven[input])].name;
  return plan.rotary[input] ? fmt::format("{} at {:.4f} deg", name, math::degrees(value))
                            : fmt::format("{} at {:.5g} mm", name, value * 1e3);
}

class Simulation {
 public:
  Simulation(const Linkage& l, const LinkagePlan& plan, std::span<const InputDrive> drives,
             const SimulationOptions& options, const SimulationOutput& output, const SimulationWatch& watch)
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
    friction_ =
        std::any_of(l.joints.begin(), l.joints.end(), [](const LinkageJoint& j) { return j.friction > 0; });
  }

  SimulationReport run(std::span<const double> times, const RunContext* context) {
    breaks_ = breaks_of(l_, drives_, times.front(), times.back());
    if (!start(times.front())) return std::move(report_);
    std::vector<double> y = state();
    std::vector<double> tolerances;
    const auto free = dynamics_.free();
    for (const std::span<const double> coarser : {options_.value_resolution, options_.rate_resolution})
      for (std::size_t i = 0; i < free.size(); ++i) {
        const double asked = options_.absolute_tolerance * (plan_.rotary[free[i]] ? 1 : plan_.size);
        tolerances.push_back(coarser.empty() ? asked : std::max(asked, coarser[i]));
      }
    tolerances.push_back(work_tolerance());
    std::vector<math::OdeEvent> events;
    if (stops_at_changes()) events.resize(2, {.crossing = math::OdeCrossing::falling});
    if (watches_rest()) events.push_back({.crossing = math::OdeCrossing::either});
    if (friction_ && !watches_rest())
      for (std::size_t j = 0; j < l_.joints.size(); ++j)
        if (l_.joints[j].friction > 0) rubbing_.push_back(static_cast<int>(j));
    rates_.assign(rubbing_.size(), 1.0);
    events.resize(events.size() + rubbing_.size(), {.crossing = math::OdeCrossing::either});
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
        if (watches_rest()) values[i] = now[1];
        if (!rubbing_.empty()) rubbing_rates(t, now);
        std::copy(rates_.begin(), rates_.end(),
                  values.begin() + static_cast<std::ptrdiff_t>(first_watched_ - rates_.size()));
        // Beyond what can be placed they stay what they were.
        if (watch_.count > 0 && watched(t, now).status == Status::done) watch_.values(instant_, watched_);
        std::copy(watched_.begin(), watched_.end(),
                  values.begin() + static_cast<std::ptrdiff_t>(first_watched_));
      };
      hooks.event = [&](double t, std::span<const std::size_t> which, std::span<double> now) {
        return act(t, which, now);
      };
    }
    if (stuck_) {  // from the start on
      show(times.front(), y);
      finish({.t = times.front()}, y);
      return std::move(report_);
    }
    span_ = times.back() - times.front();
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

 private:
  static std::vector<bool> free_of(std::span<const InputDrive> drives) {
    std::vector<bool> free;
    for (const InputDrive& c : drives) free.push_back(!c.law);
    return free;
  }
  static std::size_t count_free(std::span<const InputDrive> drives) {
    return static_cast<std::size_t>(
        std::count_if(drives.begin(), drives.end(), [](const InputDrive& c) { return !c.law; }));
  }
  // Of an only input; many have no use for it.
  double first_inertia() const { return dynamics_.inertia().empty() ? 0 : dynamics_.inertia()[0]; }
  bool stops_at_changes() const {
    return branch_ && branch_->has_change_points() && options_.at_change_point != AtChangePoint::smooth;
  }
  bool watches_rest() const { return friction_ && dynamics_.free().size() == 1; }

  // ---- state: values and rates of the free inputs, work -------------------------------------------------

  std::vector<double> state() const {
    std::vector<double> y;
    for (const std::size_t k : dynamics_.free()) y.push_back(inputs_[k].value);
    for (const std::size_t k : dynamics_.free()) y.push_back(inputs_[k].rate);
    y.push_back(0);
    return y;
  }
  void put(double t, std::span<const double> y) {
    const auto free = dynamics_.free();
    for (std::size_t i = 0; i < free.size(); ++i) inputs_[free[i]] = {y[i], y[free.size() + i], 0};
    for (const auto& [k, curve] : laws_) {
      const math::Motion m = curve(t);
      inputs_[k] = {m.value, m.rate, m.acceleration};
    }
  }
  // Work is held to the relative tolerance of what energies there are; without a measure it is left to the
  // steps that the motion needs.
  double work_tolerance() const {
    double scale = start_kinetic_;
    for (const PartMass& m : plan_.masses) scale += m.mass * std::abs(l_.gravity) * plan_.size;
    for (const LinearSpring& s : l_.springs) scale += s.stiffness * plan_.size * plan_.size / 100;
    return scale > 0 ? options_.relative_tolerance * scale : 1e30;
  }

  // ---- equations of motion ------------------------------------------------------------------------------

  struct Answer {
    Status status = Status::done;
    double power = 0, inertia = 0;
  };
  // Accelerations of the free inputs, in inputs_.
  Answer solve(double t) {
    if (!branch_) {
      const Status status = dynamics_.solve(t, inputs_);
      return {status == Status::done && changed_side() ? Status::branch_lost : status, dynamics_.power,
              first_inertia()};
    }
    const double value = inputs_[0].value;
    if (branch_->has_change_points()) {
      const SmoothBranch::Near near = branch_->nearest(value);
      const double x = (value - near.value) / branch_->half_width();
      if (std::abs(x) < 1) return interpolated(t, near.value, x);
      branch_->set_modes(value, dynamics_.motion);
    }
    const Status status = dynamics_.solve(t, inputs_);
    return {status, dynamics_.power, first_inertia()};
  }
  Answer interpolated(double t, double centre, double x) {
    const ChangeZone::Weights weights = ChangeZone::interpolation(x);
    const double value = inputs_[0].value;
    double acceleration = 0;
    Answer out;
    for (std::size_t i = 0; i < ChangeZone::nodes.size() && out.status == Status::done; ++i) {
      inputs_[0].value = centre + ChangeZone::nodes[i] * branch_->half_width();
      branch_->set_modes(inputs_[0].value, dynamics_.motion);
      out.status = dynamics_.solve(t, inputs_);
      acceleration += weights[i] * inputs_[0].acceleration;
      out.power += weights[i] * dynamics_.power;
      out.inertia += weights[i] * first_inertia();
    }
    inputs_[0].value = value;
    inputs_[0].acceleration = acceleration;
    return out;
  }
  bool slope(double t, std::span<const double> y, std::span<double> rate) {
    if (t > horizon_) return false;
    put(t, y);
    const Answer answer = solve(t);
    last_status_ = answer.status;
    if (answer.status != Status::done) {
      failed_group_ = dynamics_.motion.failed_group;
      restore();
      return false;
    }
    const auto free = dynamics_.free();
    for (std::size_t i = 0; i < free.size(); ++i) {
      rate[i] = inputs_[free[i]].rate;
      rate[free.size() + i] = inputs_[free[i]].acceleration;
    }
    rate[2 * free.size()] = answer.power;
    return true;
  }

  // ---- general groups: stay on the branch ---------------------------------------------------------------

  bool changed_side() const {
    for (std::size_t g = 0; g < plan_.groups.size(); ++g)
      if (!traits_of(plan_.groups[g]).closed_form && last_sines_[g] * dynamics_.motion.groups[g].sine < 0)
        return true;
    return false;
  }
  void remember() {
    for (std::size_t g = 0; g < plan_.groups.size(); ++g) last_sines_[g] = dynamics_.motion.groups[g].sine;
    if (!plan_.closed_form()) good_parts_ = dynamics_.motion.parts;
  }
  // A search that went astray starts from the last good place again.
  void restore() {
    if (!good_parts_.empty()) dynamics_.motion.parts = good_parts_;
  }

  // ---- start, steps, output -----------------------------------------------------------------------------

  bool start(double t) {
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
        report_.message = start_message(report_.status);
        return false;
      }
    }
    Answer answer = solve(t);
    if (watches_rest() && inputs_[dynamics_.free()[0]].rate == 0) {
      const InputMotion here = inputs_[dynamics_.free()[0]];
      stuck_ = holds(t);
      inputs_[dynamics_.free()[0]] = here;
      answer = solve(t);
    }
    if (answer.status != Status::done) {
      report_.status = answer.status;
      report_.group = dynamics_.motion.failed_group;
      report_.message = start_message(answer.status);
      return false;
    }
    remember();
    neighbours(inputs_[0].value);
    const LinkageMotion& m = placed();
    start_kinetic_ = kinetic(answer.inertia);
    start_potential_ = potential_energy(l_, plan_, m);
    last_time_ = t;
    last_ = inputs_[0];
    return true;
  }
  std::string start_message(Status status) const {
    if (dynamics_.motion.failed_group >= 0)
      return "the start does not work: " + assembly_gap_text(plan_, dynamics_.motion, 0, inputs_[0].value);
    if (status == Status::singular)
      return "a free joint moves no mass, so its motion does not follow from the forces";
    if (status == Status::self_locking)
      return fmt::format("friction locks the linkage at the start, with {}: {}", stands(), jams);
    if (status == Status::not_converged) return "the joint forces of the start do not settle";
    return "the start does not work";
  }
  // The motion where inputs_ say, accelerations included.
  const LinkageMotion& placed() {
    if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
    solve_motion(plan_, inputs_, dynamics_.motion);
    return dynamics_.motion;
  }
  double kinetic(double inertia) const {
    if (plan_.inputs() == 1) return inertia * inputs_[0].rate * inputs_[0].rate / 2;
    return kinetic_energy(plan_, dynamics_.motion);
  }

  bool show(double t, std::span<const double> y) {
    put(t, y);
    const Answer answer = solve(t);
    if (answer.status != Status::done) return true;  // beyond what the step hook will end
    const LinkageMotion& motion = placed();
    SimulationInstant now{.time = t, .status = motion.status, .inputs = inputs_, .motion = &motion};
    now.kinetic = kinetic(answer.inertia);
    now.work = y.back() + kinks_;
    if (motion.status == Status::done || motion.status == Status::singular) {
      now.potential =
          motion.status == Status::done ? potential_energy(l_, plan_, motion) : interpolated_potential();
      now.drift = (now.kinetic - start_kinetic_) + (now.potential - start_potential_) - now.work;
      report_.largest_drift = std::max(report_.largest_drift, std::abs(now.drift));
      report_.peak_energy = std::max(
          {report_.peak_energy, now.kinetic, std::abs(now.potential - start_potential_), std::abs(now.work)});
    }
    report_.time = t;
    return !output_ || output_(now);
  }
  // An instant for those who watch.
  const SimulationInstant& watched(double t, std::span<const double> y) {
    put(t, y);
    instant_ = {.time = t, .status = solve(t).status, .inputs = inputs_, .work = y.back() + kinks_};
    if (instant_.status == Status::done) {
      instant_.motion = &placed();
      instant_.status = instant_.motion->status;
    }
    if (instant_.status != Status::done) restore();
    return instant_;
  }
  // Exactly at a change point the parts behind it have no place of their own.
  double interpolated_potential() {
    const InputMotion here = inputs_[0];
    const SmoothBranch::Near near = branch_->nearest(here.value);
    const ChangeZone::Weights weights =
        ChangeZone::interpolation((here.value - near.value) / branch_->half_width());
    double sum = 0;
    for (std::size_t i = 0; i < ChangeZone::nodes.size(); ++i) {
      inputs_[0].value = near.value + ChangeZone::nodes[i] * branch_->half_width();
      sum += weights[i] * potential_energy(l_, plan_, placed());
    }
    inputs_[0] = here;
    placed();
    return sum;
  }

  bool after_step(double t, std::span<const double> y) {
    if (watch_.note && watched(t, y).status == Status::done && !watch_.note(instant_, {})) return false;
    put(t, y);
    const double time_before = last_time_;
    const InputMotion before = last_;
    last_time_ = t;
    last_ = inputs_[0];
    report_.time = t;
    if (friction_ && chatters(t)) return false;
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
  // Watches groups that come to their dead points: their sine falls to zero evenly in time. Steps are kept
  // from reaching beyond; near enough the motion ends.
  bool clear_of_limits(double t, double step) {
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
  // Whether the end of the branch that the input is nearer to is a limit of this group.
  bool ends_here(int group) const {
    const RangeEnd& end = nearer_end();
    if (end.kind != EndKind::limit && end.kind != EndKind::singular) return false;
    if (std::find(end.groups.begin(), end.groups.end(), group) == end.groups.end()) return false;
    return std::abs(inputs_[0].value - end.value) <
           std::abs(inputs_[0].value - branch_->nearest(inputs_[0].value).value);
  }
  const RangeEnd& nearer_end() const {
    const BranchPath& path = branch_->path();
    const double value = inputs_[0].value;
    return value - path.low.value < path.high.value - value ? path.low : path.high;
  }

  // ---- change points ------------------------------------------------------------------------------------

  void neighbours(double value) {
    below_ = -infinity;
    above_ = infinity;
    if (!branch_ || !branch_->has_change_points()) return;
    const SmoothBranch::Near down = branch_->next(value, -1), up = branch_->next(value, 1);
    if (down.end) below_ = down.value;
    if (up.end) above_ = up.value;
  }
  // Change points between the ends of the last step, at the times of the cubic through them.
  void note_passages(double from, const InputMotion& before) {
    if (!branch_->has_change_points() || options_.at_change_point != AtChangePoint::smooth) return;
    const InputMotion& now = inputs_[0];
    const double sense = now.value > before.value ? 1 : -1, span = last_time_ - from;
    double value = before.value;
    while (true) {
      const SmoothBranch::Near next = branch_->next(value, sense);
      if (!next.end || (next.value - now.value) * sense > 0) return;
      value = next.value;
      const auto yet_before = [&](double s) {
        const double r = 1 - s;
        const double there = before.value * r * r * (1 + 2 * s) + now.value * s * s * (1 + 2 * r) +
                             span * s * r * (r * before.rate - s * now.rate);
        return (there - value) * sense < 0;
      };
      const double share = math::bisect(yet_before, 0, 1, {.halvings = 50}).inside;
      report_.passages.push_back({from + span * share, value, next.end->groups, 0});
    }
  }

  math::OdeAction act(double t, std::span<const std::size_t> which, std::span<double> y) {
    math::OdeAction action = math::OdeAction::go_on;
    if (watch_.note && which.back() >= first_watched_) {
      std::vector<std::size_t> crossed;
      for (const std::size_t event : which)
        if (event >= first_watched_) crossed.push_back(event - first_watched_);
      if (watched(t, y).status == Status::done && !watch_.note(instant_, crossed))
        return math::OdeAction::stop;
    }
    for (const std::size_t event : which) {
      if (event >= first_watched_) continue;
      if (!rubbing_.empty()) {
        const int joint = rubbing_[event];
        put(t, y);
        if (sticks(t, joint)) {
          chattering_ = joint;
          rests_ = fastest() < 1e-5 * largest_rate_;
          return math::OdeAction::stop;
        }
        action = math::OdeAction::restart;  // friction changes its sign
        continue;
      }
      if (!stops_at_changes() || event >= 2) {
        put(t, y);
        if (holds(t)) {
          stuck_ = true;
          return math::OdeAction::stop;
        }
        action = math::OdeAction::restart;  // friction changes its sign
        continue;
      }
      const double value = event == 0 ? below_ : above_, sense = event == 0 ? -1 : 1;
      const SmoothBranch::Near here = branch_->nearest(value);
      if (options_.at_change_point == AtChangePoint::stop) {
        report_.passages.push_back({t, value, here.end->groups, 0});
        report_.group = here.end->groups.empty() ? -1 : here.end->groups.front();
        at_change_ = true;
        return math::OdeAction::stop;
      }
      const std::vector<int> groups = here.end->groups;
      const std::optional<double> lost = kink(value, sense, y[1]);
      report_.passages.push_back({t, value, groups, lost.value_or(0)});
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

  // Velocities of the parts for a unit rate at a change point, with places and directions.
  std::vector<PartState<double>> unit_motion(double value) {
    std::vector<PartState<double>> sum(plan_.parts.size());
    for (PartState<double>& s : sum) s = {{0, 0}, {0, 0}, {0, 0}, 0, {0, 0}, 0};
    const ChangeZone::Weights weights = ChangeZone::interpolation(0);
    for (std::size_t i = 0; i < ChangeZone::nodes.size(); ++i) {
      const InputMotion there{value + ChangeZone::nodes[i] * branch_->half_width(), 1, 0};
      branch_->set_modes(there.value, dynamics_.motion);
      solve_motion(plan_, std::span(&there, 1), dynamics_.motion);
      if (dynamics_.motion.status != Status::done) return {};
      for (std::size_t p = 1; p < sum.size(); ++p) {
        const PartState<double>& s = dynamics_.motion.parts[p];
        sum[p].origin = sum[p].origin + weights[i] * s.origin;
        sum[p].direction = sum[p].direction + weights[i] * s.direction;
        sum[p].velocity = sum[p].velocity + weights[i] * s.velocity;
        sum[p].speed += weights[i] * s.speed;
      }
    }
    return sum;
  }
  // Turns onto the other branch through a change point: the impact acts only against motion that the new
  // branch does not have, so the momentum along it stays. Returns the energy it costs; nothing when the
  // modes that keep their signs do not start where the linkage stands.
  std::optional<double> kink(double value, double sense, double& rate) {
    const std::vector<PartState<double>> before = unit_motion(value);
    branch_->set_modes(value - sense * branch_->half_width(), dynamics_.motion);
    const std::vector<double> kept = dynamics_.motion.modes;
    branch_.emplace(plan_, value + sense * branch_->half_width(), kept);
    if (branch_->path().status != Status::done) return {};
    const std::vector<PartState<double>> after = unit_motion(value);
    if (before.empty() || after.empty()) return {};
    for (std::size_t p = 1; p < before.size(); ++p)
      if (norm(after[p].origin - before[p].origin) > 1e-6 * plan_.size ||
          norm(after[p].direction - before[p].direction) > 1e-6)
        return {};
    const auto inertia = [&](const std::vector<PartState<double>>& a,
                             const std::vector<PartState<double>>& b) {
      double sum = 0;
      for (std::size_t p = 1; p < a.size(); ++p) {
        const PartMass& m = plan_.masses[p];
        const Vec<double> arm = rotate(before[p].direction, m.moment);
        sum += m.mass * dot(a[p].velocity, b[p].velocity) + a[p].speed * cross(arm, b[p].velocity) +
               b[p].speed * cross(arm, a[p].velocity) + m.inertia * a[p].speed * b[p].speed;
      }
      return sum;
    };
    const double new_rate = rate * inertia(before, after) / inertia(after, after);
    const double lost =
        (inertia(before, before) * rate * rate - inertia(after, after) * new_rate * new_rate) / 2;
    rate = new_rate;
    return lost;
  }

  // Where friction turns round again and again while time hardly passes, a joint sticks while others move:
  // the equations of joints that slide have no motion there. Before the place where friction locks forces
  // grow without bound, and time hardly passes either.
  bool chatters(double t) {
    if (senses_.empty()) {
      senses_.assign(l_.joints.size(), 0.0);
      turns_.assign(l_.joints.size(), 0);
      window_ = t;
    }
    solve(t);
    const double largest = fastest();
    largest_rate_ = std::max(largest_rate_, largest);
    for (std::size_t j = 0; j < l_.joints.size(); ++j) {
      if (l_.joints[j].friction == 0) continue;
      const double rate = joint_motion(l_, plan_, dynamics_.motion, static_cast<int>(j)).rate;
      const double sense = rate > 0 ? 1 : rate < 0 ? -1 : 0;
      turns_[j] += senses_[j] * sense < 0;
      senses_[j] = sense;
    }
    if (++steps_ % chatter_steps != 0) return false;
    const auto most = std::max_element(turns_.begin(), turns_.end());
    const bool creeps = t - window_ < chatter_share * span_, still = creeps && *most >= chatter_steps / 10;
    jammed_ = creeps && !still && locks_ahead(t);
    if (still) {
      chattering_ = static_cast<int>(most - turns_.begin());
      rests_ = largest < 1e-5 * largest_rate_;
    }
    window_ = t;
    std::fill(turns_.begin(), turns_.end(), 0);
    return still || jammed_;
  }

  // Whether friction locks a millionth of a radian, or of the linkage's size, further on.
  bool locks_ahead(double t) {
    const std::vector<InputMotion> here = inputs_;
    for (const std::size_t k : dynamics_.free())
      inputs_[k].value += std::copysign(1e-6 * (plan_.rotary[k] ? 1 : plan_.size), inputs_[k].rate);
    const bool locks = solve(t).status == Status::self_locking;
    inputs_ = here;
    restore();
    return locks;
  }
  double fastest() const {
    double largest = 0;
    for (const std::size_t k : dynamics_.free()) largest = std::max(largest, std::abs(inputs_[k].rate));
    return largest;
  }
  // Rates of the joints with friction; beyond what can be placed they stay what they were.
  void rubbing_rates(double t, std::span<const double> y) {
    put(t, y);
    LinkageMotion& motion = dynamics_.motion;
    solve_position(plan_, inputs_, motion);
    if (motion.status != Status::done) return restore();
    solve_velocity(plan_, inputs_, motion);
    for (std::size_t i = 0; i < rubbing_.size(); ++i)
      rates_[i] = joint_motion(l_, plan_, motion, rubbing_[i]).rate;
  }
  // A joint that has come to rest sticks when friction stops it either way. inputs_ are those of the moment.
  bool sticks(double t, int joint) {
    const std::vector<InputMotion> here = inputs_;
    LinkageMotion& motion = dynamics_.motion;
    const auto rate_of = [&](std::span<const InputMotion> inputs) {
      solve_velocity(plan_, inputs, motion);
      return joint_motion(l_, plan_, motion, joint).rate;
    };
    solve_position(plan_, here, motion);
    const double rate = rate_of(here);
    std::vector<double> share;
    double square = 0;
    for (const std::size_t k : dynamics_.free()) {
      std::vector<InputMotion> one = here;
      for (InputMotion& i : one) i.rate = 0;
      one[k].rate = 1;
      share.push_back(rate_of(one));
      square += share.back() * share.back();
    }
    if (!(square > 1e-12)) return false;  // the joint stands still whatever moves
    bool stopped = true;
    for (const double sense : {1.0, -1.0}) {
      inputs_ = here;
      const double wanted = sense * 1e-9 - rate;
      for (std::size_t i = 0; i < share.size(); ++i)
        inputs_[dynamics_.free()[i]].rate += wanted * share[i] / square;
      if (solve(t).status != Status::done) continue;  // it cannot move in this sense
      solve_motion(plan_, inputs_, motion);
      stopped = stopped && joint_motion(l_, plan_, motion, joint).acceleration * sense < 0;
    }
    inputs_ = here;
    return stopped;
  }

  // Friction holds a linkage at rest when it stops motion either way.
  bool holds(double t) {
    const std::size_t k = dynamics_.free()[0];
    const double value = inputs_[k].value;
    for (const double sense : {1.0, -1.0}) {
      inputs_[k] = {value, sense * 1e-9, 0};
      // Where there is no answer it cannot move in this sense.
      if (solve(t).status == Status::done && !(inputs_[k].acceleration * sense < 0)) return false;
    }
    return true;
  }

  // ---- end ----------------------------------------------------------------------------------------------

  void finish(const math::OdeReport& ode, std::span<const double> y) {
    report_.steps = ode.steps;
    report_.evaluations = ode.evaluations;
    report_.time = ode.t;
    put(ode.t, y);
    const std::string where = fmt::format("{:.6g} s with {}", at_limit_ ? limit_time_ : ode.t, stands());
    if (chattering_ < 0 && friction_ && ode.status != Status::done && ode.status != Status::cancelled &&
        ode.status != Status::deadline && !turns_.empty()) {
      // Steps that became too short before the window was full.
      const auto most = std::max_element(turns_.begin(), turns_.end());
      if (*most >= 5) chattering_ = static_cast<int>(most - turns_.begin());
    }
    if (stuck_ || (chattering_ >= 0 && rests_)) {
      report_.status = Status::at_rest;
      report_.message = fmt::format("friction holds the linkage at rest from {} on", where);
    } else if (jammed_) {
      report_.status = Status::self_locking;
      report_.message = fmt::format("friction locks the linkage at {}: {}", where, jams);
    } else if (chattering_ >= 0) {
      report_.status = Status::limit_reached;
      report_.message = fmt::format(
          "the motion cannot be followed beyond {}: the friction of joint '{}' holds it while others move on "
          "(sticking joints are not computed)",
          where, l_.joints[at(chattering_)].name);
    } else if (at_change_) {
      report_.status = Status::limit_reached;
      report_.message =
          fmt::format("the motion stops at {}: '{}' is at a change point, where it {}", where,
                      plan_.groups[at(report_.group)].name,
                      options_.at_change_point == AtChangePoint::stop
                          ? "can continue in either assembly mode"
                          : "cannot continue with the sign of its mode: that branch does not meet this one");
    } else if (at_limit_) {
      limit(where);
    } else if (ode.status == Status::limit_reached || ode.status == Status::infeasible) {
      report_.group = failed_group_;
      const bool kept = last_status_ == Status::not_converged || last_status_ == Status::self_locking;
      report_.status = kept ? last_status_ : Status::limit_reached;
      if (last_status_ == Status::self_locking)
        report_.message = fmt::format("friction locks the linkage at {}: {}", where, jams);
      else if (report_.group >= 0)
        limit(where);
      else
        report_.message = fmt::format("the motion cannot be followed beyond {}", where);
    } else if (ode.status != Status::done) {
      report_.status = ode.status;
      report_.message = fmt::format("ended at {:.6g} s: {}", ode.t, ode.message);
    }
  }
  void limit(const std::string& where) {
    report_.status = Status::limit_reached;
    report_.message = fmt::format(
        "'{}' reaches its dead point at {}: the joint turns back there while the linkage continues in the "
        "other "
        "assembly mode",
        plan_.groups[at(report_.group)].name, where);
    if (at_limit_) report_.time = limit_time_;
  }
  std::string stands() const {
    std::string out;
    for (const std::size_t k : dynamics_.free()) {
      double value = inputs_[k].value;
      if (at_limit_ && branch_) value = nearer_end().value;
      if (at_change_) value = report_.passages.back().value;
      out += (out.empty() ? "" : ", ") + place(l_, plan_, k, value);
    }
    return out;
  }

  const Linkage& l_;
  const LinkagePlan& plan_;
  std::span<const InputDrive> drives_;
  const SimulationOptions& options_;
  const SimulationOutput& output_;
  const SimulationWatch& watch_;
  LinkageDynamics dynamics_;
  std::vector<InputMotion> inputs_;
  struct Law {
    std::size_t input;
    math::MotionCurve curve;
  };
  std::vector<Law> laws_;
  std::optional<SmoothBranch> branch_;
  bool friction_ = false;
  std::vector<double> last_sines_;
  std::vector<PartState<double>> good_parts_;
  std::size_t first_watched_ = 0;  // among the events
  std::vector<double> watched_;    // last values
  SimulationInstant instant_;
  double start_kinetic_ = 0, start_potential_ = 0, kinks_ = 0;
  double last_time_ = 0;
  InputMotion last_;
  double horizon_ = infinity, limit_time_ = 0;
  double below_ = -infinity, above_ = infinity;
  bool at_limit_ = false, at_change_ = false, stuck_ = false;
  std::vector<int> rubbing_;             // joints with friction, when several inputs are free
  std::vector<double> rates_;            // of these joints
  std::vector<double> breaks_, senses_;  // senses of joints with friction, one a joint
  std::vector<long> turns_;              // of the senses, within the window
  double span_ = 1, window_ = 0, largest_rate_ = 0;
  long steps_ = 0;
  int chattering_ = -1;  // joint
  bool rests_ = false;
  bool jammed_ = false;  // friction locks
  Status last_status_ = Status::done;
  int failed_group_ = -1;
  SimulationReport report_;
};

}  // namespace

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
