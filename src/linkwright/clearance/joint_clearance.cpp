// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/joint_clearance.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/clearance/open_linkage.h"
#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::clearance {
namespace {

using planar::Linkage, planar::LinkageJoint, planar::LinkageMotion, planar::LinkagePlan, planar::InputMotion;

void require_clearances(const Linkage& l, std::span<const JointClearance> clearances) {
  std::vector<int> joints;
  for (const JointClearance& c : clearances) joints.push_back(c.joint);
  require_free_pins(l, joints);
  const double size = planar::size_of(l);
  for (const JointClearance& c : clearances) {
    const LinkageJoint& j = l.joints[at(c.joint)];
    LINKWRIGHT_REQUIRE(c.clearance > 0 && c.clearance < size / 2,
                       "joint '{}': clearance {} m must be positive and less than {} m", j.name, c.clearance,
                       size / 2);
    LINKWRIGHT_REQUIRE(
        c.damping >= 0 && std::isfinite(c.damping) && std::isfinite(c.angle) && std::isfinite(c.rate),
        "joint '{}': angle {} rad, rate {} rad/s, damping {} N m s", j.name, c.angle, c.rate, c.damping);
  }
}

std::vector<InputMotion> standing(std::span<const double> inputs) {
  std::vector<InputMotion> out;
  for (const double value : inputs) out.push_back({value, 0, 0});
  return out;
}

// When a body is placed: number of its group, -1 of the ground.
int placed(const LinkagePlan& plan, int body) { return plan.group_of_part[at(plan.bodies[at(body)].part)]; }

double angle_of(const LinkagePlan& plan, const LinkageMotion& motion, int body) {
  return math::angle_of(planar::body_state(plan, motion, body).direction);
}

// Values and rates of the inputs of the bars for wanted absolute angles and rates: the carriers move little
// when short bars turn, so repetition converges.
Status start_bars(const ClearedLinkage& cleared, std::span<const JointClearance> clearances,
                  std::vector<InputMotion>& inputs) {
  constexpr int most = 200;
  LinkageMotion motion(cleared.plan);
  for (int iteration = 0; iteration < most; ++iteration) {
    planar::solve_motion(cleared.plan, inputs, motion);
    if (motion.status != Status::done) return motion.status;
    double change = 0;
    for (std::size_t k = 0; k < cleared.bars.size(); ++k) {
      const ClearanceBar& bar = cleared.bars[k];
      InputMotion& input = inputs[at(bar.input)];
      const double off =
          math::angle_difference(clearances[k].angle, angle_of(cleared.plan, motion, bar.body));
      const double slow = clearances[k].rate - planar::body_state(cleared.plan, motion, bar.body).speed;
      input.value += off;
      input.rate += slow;
      change = std::max({change, std::abs(off), std::abs(slow) / (1 + std::abs(clearances[k].rate))});
    }
    if (change <= 1e-14) return Status::done;
  }
  return Status::not_converged;
}

// To how many roundings of the whole linkage the direction of a short bar is known.
constexpr double roundings = 100;

// The rounding error of the free inputs of a cleared linkage and their rates. Places are known to roundings
// of the size of the linkage, which is many in the angle of a bar that is short against it; the rate of the
// bar, which swings about the direction of its force, is known to that times the frequency of the swing.
// Steps that are to be more exact than that only follow the rounding.
struct Resolution {
  std::vector<double> values, rates;
};
Resolution resolution_of(const ClearedLinkage& cleared, std::span<const planar::InputDrive> drives,
                         double tolerance, double t, std::span<const InputMotion> start) {
  std::vector<bool> is_free;
  for (const planar::InputDrive& c : drives) is_free.push_back(!c.law);
  planar::LinkageDynamics dynamics(cleared.linkage, cleared.plan, is_free);
  std::vector<InputMotion> inputs(start.begin(), start.end());
  Resolution out;
  for (const std::size_t k : dynamics.free()) {
    out.values.push_back(0);
    out.rates.push_back(0);
    const auto bar = std::find_if(cleared.bars.begin(), cleared.bars.end(),
                                  [k](const ClearanceBar& b) { return at(b.input) == k; });
    if (bar == cleared.bars.end()) continue;
    const double angle =
        roundings * std::numeric_limits<double>::epsilon() * cleared.plan.size / bar->clearance;
    if (angle < tolerance) continue;
    constexpr double step = 1e-3;  // rad
    double apart = 0;
    bool solved = true;
    for (const double side : {1.0, -1.0}) {
      inputs[k].value = start[k].value + side * step;
      solved = solved && dynamics.solve(t, inputs) == Status::done;
      apart += side * inputs[k].acceleration;
    }
    std::copy(start.begin(), start.end(), inputs.begin());
    if (!solved || !std::isfinite(apart)) continue;
    const double frequency = std::sqrt(std::abs(apart) / (2 * step));
    out.values.back() = angle;
    out.rates.back() = angle * frequency;
  }
  return out;
}

// Follows the tensions along a simulation.
class Watcher {
 public:
  Watcher(const ClearedLinkage& cleared, JointClearanceRun& run, AtSeparation at_separation)
      : cleared_(cleared),
        run_(run),
        stops_(at_separation == AtSeparation::stop),
        apart_(cleared.bars.size(), false),
        parted_at_(cleared.bars.size(), 0),
        apart_time_(cleared.bars.size(), 0) {}

  void tensions(const planar::SimulationInstant& i, std::span<double> out) {
    solve(i);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = tension(i, k);
  }

  /// States at a row or step; false when there is no contact at the start and the simulation is to end.
  bool look(const planar::SimulationInstant& i) {
    solve(i);
    for (std::size_t k = 0; k < cleared_.bars.size(); ++k) {
      const planar::PartState<double> s = planar::body_state(cleared_.plan, *i.motion, cleared_.bars[k].body);
      ClearanceState& now = run_.end[k];
      now.angle += math::angle_difference(math::angle_of(s.direction), now.angle);
      now.rate = s.speed;
      now.acceleration = s.angular_acceleration;
      now.tension = tension(i, k);
      ContactValidity& validity = run_.joints[k];
      validity.min_tension = std::min(validity.min_tension, now.tension);
      if (!started_ && !(now.tension > 0)) part(k, i.time);
    }
    started_ = true;
    for (std::size_t k = 0; k < run_.inputs.size(); ++k) run_.inputs[k] = i.inputs[k];
    run_.kinetic = planar::kinetic_energy(cleared_.plan, *i.motion);
    run_.potential = planar::potential_energy(cleared_.linkage, cleared_.plan, *i.motion);
    run_.work = i.work;
    return run_.parted < 0;
  }

  bool note(const planar::SimulationInstant& i, std::span<const std::size_t> crossed) {
    look(i);
    for (const std::size_t k : crossed) {
      ++run_.joints[k].sign_changes;
      if (apart_[k]) {
        apart_[k] = false;
        apart_time_[k] += i.time - parted_at_[k];
      } else {
        part(k, i.time);
      }
    }
    return run_.parted < 0;
  }

  void finish(double from) {
    const double duration = run_.simulation.time - from;
    for (std::size_t k = 0; k < apart_.size(); ++k) {
      if (apart_[k]) apart_time_[k] += run_.simulation.time - parted_at_[k];
      run_.joints[k].separated = duration > 0 ? apart_time_[k] / duration : 0;
    }
  }

 private:
  void solve(const planar::SimulationInstant& i) {
    planar::solve_forces(cleared_.linkage, cleared_.plan, i, forces_);
  }
  double tension(const planar::SimulationInstant& i, std::size_t k) const {
    const ClearanceBar& bar = cleared_.bars[k];
    const planar::PartState<double> s = planar::body_state(cleared_.plan, *i.motion, bar.body);
    const bool to_second = cleared_.linkage.joints[at(bar.far_joint)].first.point == 1;
    return (to_second ? -1 : 1) * dot(forces_.joints[at(bar.far_joint)].force, s.direction);
  }
  void part(std::size_t k, double t) {
    apart_[k] = true;
    parted_at_[k] = t;
    if (std::isnan(run_.joints[k].first_separation)) run_.joints[k].first_separation = t;
    if (stops_ && run_.parted < 0) run_.parted = static_cast<int>(k);
  }

  const ClearedLinkage& cleared_;
  JointClearanceRun& run_;
  bool stops_, started_ = false;
  std::vector<bool> apart_;
  std::vector<double> parted_at_, apart_time_;  // s
  planar::LinkageForces forces_;
};

}  // namespace

ClearedLinkage with_clearance(const Linkage& linkage, std::span<const JointClearance> clearances,
                              std::span<const double> inputs) {
  require_clearances(linkage, clearances);
  ClearedLinkage out;
  const planar::PlanResult ideal = planar::plan_linkage(linkage);
  if (!ideal.problems.empty()) {
    out.status = Status::infeasible;
    out.message = to_string(ideal.problems.front().message);
    return out;
  }
  LinkageMotion motion(ideal.plan);
  planar::solve_position(ideal.plan, standing(inputs), motion);
  if (motion.status != Status::done) {
    out.status = motion.status;
    out.message = "without clearance the start does not work: " +
                  to_string(planar::assembly_gap_text(ideal.plan, motion, 0, inputs.empty() ? 0 : inputs[0]));
    return out;
  }
  out.linkage = linkage;
  Linkage& l = out.linkage;
  l.modes.clear();  // pairs change; places at the start give the modes
  for (std::size_t b = 1; b < l.bodies.size(); ++b) {
    const planar::PartState<double> s = planar::body_state(ideal.plan, motion, static_cast<int>(b));
    l.bodies[b].start = math::Pose{s.origin.x, s.origin.y, math::angle_of(s.direction)};
  }
  for (const JointClearance& c : clearances) {
    const LinkageJoint pin = l.joints[at(c.joint)];
    const planar::LinkageBody& first = linkage.bodies[at(pin.first.body)];
    const auto where =
        planar::point_motion(ideal.plan, motion, pin.first.body, first.points[at(pin.first.point)].at)
            .position;
    ClearanceBar bar{.body = static_cast<int>(l.bodies.size()), .clearance = c.clearance};
    l.bodies.push_back({.name = pin.name + " clearance",
                        .points = {{"pin", {0, 0}}, {"bush", {c.clearance, 0}}},
                        .mass = planar::BodyMass{},
                        .start = math::Pose{where.x, where.y, c.angle}});
    // The joint itself stays at one end of the bar; its other end gets a new one. The bar is the second body
    // where it is carried, so that the input is its angle from the carrier.
    const bool by_first = placed(ideal.plan, pin.first.body) <= placed(ideal.plan, pin.second.body);
    LinkageJoint near = pin, far = pin;
    near.first = by_first ? pin.first : pin.second;
    near.second = {bar.body, by_first ? 0 : 1};
    far.name = pin.name + " clearance";
    far.first = {bar.body, by_first ? 1 : 0};
    far.second = by_first ? pin.second : pin.first;
    bar.carrier = near.first.body;
    bar.input = static_cast<int>(l.driven.size());
    bar.far_joint = static_cast<int>(l.joints.size());
    l.joints[at(c.joint)] = near;
    l.joints.push_back(far);
    l.driven.push_back(c.joint);
    if (c.damping > 0)
      l.torsion_springs.push_back(
          {.name = pin.name + " clearance", .first = 0, .second = bar.body, .damping = c.damping});
    out.bars.push_back(bar);
  }
  planar::PlanResult planned = planar::plan_linkage(l);
  if (!planned.problems.empty()) {
    out.status = Status::infeasible;
    out.message = to_string(planned.problems.front().message);
    return out;
  }
  out.plan = std::move(planned.plan);
  return out;
}

JointClearanceRun simulate_joint_clearance(const Linkage& linkage, std::span<const JointClearance> clearances,
                                           std::span<const planar::InputDrive> drives,
                                           std::span<const double> times,
                                           const planar::SimulationOptions& options,
                                           const JointClearanceOutput& output, const RunContext* context,
                                           AtSeparation at_separation, AtHopeless at_hopeless) {
  LINKWRIGHT_REQUIRE(drives.size() == linkage.driven.size(), "the linkage has {} inputs, got {}",
                     linkage.driven.size(), drives.size());
  LINKWRIGHT_REQUIRE(!clearances.empty() && !times.empty(), "{} clearances, {} times", clearances.size(),
                     times.size());
  JointClearanceRun run;
  run.joints.resize(clearances.size());
  run.simulation.time = times.front();
  std::vector<double> values;
  for (const planar::InputDrive& c : drives) {
    InputMotion start{c.value, c.rate, 0};
    if (c.law) {
      const math::Motion m = math::MotionCurve(*c.law)(times.front());
      start = {m.value, m.rate, m.acceleration};
    }
    run.inputs.push_back(start);
    values.push_back(start.value);
  }
  for (const JointClearance& c : clearances) run.end.push_back({.angle = c.angle, .rate = c.rate});
  const ClearedLinkage cleared = with_clearance(linkage, clearances, values);
  run.status = cleared.status;
  run.message = cleared.message;
  if (run.status != Status::done) return run;
  std::vector<InputMotion> inputs = run.inputs;
  inputs.resize(cleared.plan.inputs());
  run.status = start_bars(cleared, clearances, inputs);
  if (run.status != Status::done) {
    run.message = "with clearance the start does not work";
    return run;
  }
  Watcher watcher(cleared, run, at_separation);
  std::vector<planar::InputDrive> all(drives.begin(), drives.end());
  for (const ClearanceBar& bar : cleared.bars)
    all.push_back({{}, inputs[at(bar.input)].value, inputs[at(bar.input)].rate});
  StepPace pace(times.front(), times.back(), options.max_steps);
  bool hopeless = false;
  planar::SimulationWatch watch;
  if (at_separation != AtSeparation::ignore)
    watch = {.count = clearances.size(),
             .values = [&](const planar::SimulationInstant& i,
                           std::span<double> tensions) { watcher.tensions(i, tensions); },
             .note =
                 [&](const planar::SimulationInstant& i, std::span<const std::size_t> crossed) {
                   if (at_hopeless == AtHopeless::stop && !pace.step(i.time)) hopeless = true;
                   return watcher.note(i, crossed) && !hopeless;
                 }};
  const Resolution resolution =
      resolution_of(cleared, all, options.relative_tolerance, times.front(), inputs);
  planar::SimulationOptions resolved = options;
  resolved.value_resolution = resolution.values;
  resolved.rate_resolution = resolution.rates;
  run.simulation = planar::simulate_watched(
      cleared.linkage, cleared.plan, all, times, resolved,
      [&](const planar::SimulationInstant& i) {
        if (i.status == Status::done && !watcher.look(i)) return false;
        return !output || output({i, run.end});
      },
      watch, context);
  watcher.finish(times.front());
  run.status = run.simulation.status;
  run.message = to_string(run.simulation.message);
  if (hopeless && run.status == Status::done) {
    run.status = run.simulation.status = Status::not_converged;
    run.simulation.message = run.message = pace.message(run.simulation.time);
  }
  return run;
}

}  // namespace linkwright::clearance
