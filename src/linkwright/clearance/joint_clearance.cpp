#include "linkwright/clearance/joint_clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage_limits.h"
#include "linkwright/planar/linkage_reactions.h"

namespace linkwright::clearance {
namespace {

using planar::Linkage, planar::LinkageJoint, planar::LinkageMotion, planar::LinkagePlan, planar::InputMotion;

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

void require_free_pins(const Linkage& l, std::span<const JointClearance> clearances) {
  const double size = planar::size_of(l);
  for (std::size_t k = 0; k < clearances.size(); ++k) {
    const JointClearance& c = clearances[k];
    LINKWRIGHT_REQUIRE(c.joint >= 0 && at(c.joint) < l.joints.size(), "there is no joint {} among {}",
                       c.joint, l.joints.size());
    const LinkageJoint& j = l.joints[at(c.joint)];
    LINKWRIGHT_REQUIRE(j.type == planar::JointType::revolute && j.friction == 0 &&
                           std::find(l.driven.begin(), l.driven.end(), c.joint) == l.driven.end(),
                       "joint '{}' must be a revolute joint without drive and friction", j.name);
    LINKWRIGHT_REQUIRE(c.clearance > 0 && c.clearance < size / 2,
                       "joint '{}': clearance {} m must be positive and less than {} m", j.name, c.clearance,
                       size / 2);
    LINKWRIGHT_REQUIRE(
        c.damping >= 0 && std::isfinite(c.damping) && std::isfinite(c.angle) && std::isfinite(c.rate),
        "joint '{}': angle {} rad, rate {} rad/s, damping {} N m s", j.name, c.angle, c.rate, c.damping);
    for (std::size_t i = 0; i < k; ++i)
      LINKWRIGHT_REQUIRE(clearances[i].joint != c.joint, "joint '{}' is given twice", j.name);
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
  return planar::angle_of(planar::body_state(plan, motion, body).direction);
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

}  // namespace

ClearedLinkage with_clearance(const Linkage& linkage, std::span<const JointClearance> clearances,
                              std::span<const double> inputs) {
  require_free_pins(linkage, clearances);
  ClearedLinkage out;
  const planar::PlanResult ideal = planar::plan(linkage);
  if (!ideal.problems.empty()) {
    out.status = Status::infeasible;
    out.message = ideal.problems.front().message;
    return out;
  }
  LinkageMotion motion(ideal.plan);
  planar::solve_position(ideal.plan, standing(inputs), motion);
  if (motion.status != Status::done) {
    out.status = motion.status;
    out.message = "without clearance the start does not work: " +
                  planar::assembly_gap_text(ideal.plan, motion, 0, inputs.empty() ? 0 : inputs[0]);
    return out;
  }
  out.linkage = linkage;
  Linkage& l = out.linkage;
  l.modes.clear();  // pairs change; places at the start tell the modes
  for (std::size_t b = 1; b < l.bodies.size(); ++b) {
    const planar::PartState<double> s = planar::body_state(ideal.plan, motion, static_cast<int>(b));
    l.bodies[b].start = math::Pose{s.origin.x, s.origin.y, planar::angle_of(s.direction)};
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
  planar::PlanResult planned = planar::plan(l);
  if (!planned.problems.empty()) {
    out.status = Status::infeasible;
    out.message = planned.problems.front().message;
    return out;
  }
  out.plan = std::move(planned.plan);
  return out;
}

JointClearanceRun simulate_joint_clearance(const Linkage& linkage, std::span<const JointClearance> clearances,
                                           std::span<const planar::InputCourse> courses,
                                           std::span<const double> times,
                                           const planar::SimulationOptions& options,
                                           const JointClearanceOutput& output, const RunContext* context) {
  LINKWRIGHT_REQUIRE(courses.size() == linkage.driven.size(), "the linkage has {} inputs, got {}",
                     linkage.driven.size(), courses.size());
  LINKWRIGHT_REQUIRE(!clearances.empty() && !times.empty(), "{} clearances, {} times", clearances.size(),
                     times.size());
  JointClearanceRun run;
  run.joints.resize(clearances.size());
  std::vector<InputMotion> inputs;
  std::vector<double> values;
  for (const planar::InputCourse& c : courses) {
    InputMotion start{c.value, c.rate, 0};
    if (c.law) {
      const math::Motion m = math::MotionCurve(*c.law)(times.front());
      start = {m.value, m.rate, m.acceleration};
    }
    inputs.push_back(start);
    values.push_back(start.value);
  }
  const ClearedLinkage cleared = with_clearance(linkage, clearances, values);
  run.status = cleared.status;
  run.message = cleared.message;
  if (run.status != Status::done) return run;
  inputs.resize(cleared.plan.inputs());
  run.status = start_bars(cleared, clearances, inputs);
  if (run.status != Status::done) {
    run.message = "with clearance the start does not work";
    return run;
  }
  std::vector<planar::InputCourse> all(courses.begin(), courses.end());
  for (const ClearanceBar& bar : cleared.bars)
    all.push_back({{}, inputs[at(bar.input)].value, inputs[at(bar.input)].rate});

  planar::LinkageForces forces;
  std::vector<ClearanceState> now(clearances.size()), before;
  double time_before = 0;
  std::vector<double> apart(clearances.size(), 0.0);
  for (std::size_t k = 0; k < now.size(); ++k) now[k].angle = clearances[k].angle;
  const auto watch = [&](double t, std::size_t k) {
    ContactValidity& validity = run.joints[k];
    const double a = before.empty() ? now[k].tension : before[k].tension, b = now[k].tension;
    validity.least_tension = std::min(validity.least_tension, b);
    const double step = before.empty() ? 0 : t - time_before;
    const double crossing = a * b < 0 ? a / (a - b) : (b > 0 ? 1 : 0);  // share of the step before it
    if (std::isnan(validity.first_separation) && (a <= 0 || b <= 0))
      validity.first_separation = a <= 0 ? t - step : t - step + crossing * step;
    apart[k] += a > 0 && b > 0 ? 0 : a <= 0 && b <= 0 ? step : (a <= 0 ? crossing : 1 - crossing) * step;
  };
  run.simulation = planar::simulate(
      cleared.linkage, cleared.plan, all, times, options,
      [&](const planar::SimulationInstant& instant) {
        planar::solve_forces(cleared.linkage, cleared.plan, *instant.motion, instant.time,
                             instant.inputs[0].value, forces);
        for (std::size_t k = 0; k < now.size(); ++k) {
          const ClearanceBar& bar = cleared.bars[k];
          const planar::PartState<double> s = planar::body_state(cleared.plan, *instant.motion, bar.body);
          const planar::JointReaction& far = forces.joints[at(bar.far_joint)];
          const bool to_second = cleared.linkage.joints[at(bar.far_joint)].first.point == 1;
          now[k].angle += math::angle_difference(planar::angle_of(s.direction), now[k].angle);
          now[k].rate = s.speed;
          now[k].acceleration = s.angular_acceleration;
          now[k].tension = (to_second ? -1 : 1) * dot(far.force, s.direction);
          watch(instant.time, k);
        }
        before = now;
        time_before = instant.time;
        return !output || output({instant, now});
      },
      context);
  const double duration = run.simulation.time - times.front();
  for (std::size_t k = 0; k < now.size(); ++k)
    run.joints[k].separated = duration > 0 ? apart[k] / duration : 0;
  run.status = run.simulation.status;
  run.message = run.simulation.message;
  return run;
}

}  // namespace linkwright::clearance
