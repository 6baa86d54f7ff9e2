// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/samples.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// The plan of a linkage that must have one.
inline LinkagePlan planned(const Linkage& l, PlanRoute route = PlanRoute::along_groups) {
  PlanResult r = plan_linkage(l, route);
  for (const Diagnostic& d : r.problems) ADD_FAILURE() << to_string(d);
  return std::move(r.plan);
}

/// Leaves the bodies without mass, in no gravity.
inline void without_mass(Linkage& l) {
  l.gravity = 0;
  for (std::size_t b = 1; b < l.bodies.size(); ++b)
    if (!l.bodies[b].mass) l.bodies[b].mass = BodyMass{};
}

/// What keeps a linkage from being planned, without the word error.
inline std::vector<std::string> planning_problems(const Linkage& l) {
  std::vector<std::string> out;
  for (const Diagnostic& d : plan_linkage(l).problems) out.push_back(to_string(d).substr(7));
  return out;
}

/// Inputs of a sample at a share of its way, all moving towards the end with the speed of the first.
inline std::vector<InputMotion> inputs_at(const LinkageSample& s, double share, double speed,
                                          double acceleration = 0) {
  std::vector<InputMotion> out;
  for (std::size_t k = 0; k < s.from.size(); ++k) {
    const double ratio = (s.to[k] - s.from[k]) / (s.to[0] - s.from[0]);
    out.push_back({s.from[k] + share * (s.to[k] - s.from[k]), ratio * speed, ratio * acceleration});
  }
  return out;
}

inline math::Vec2 place_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& m,
                           const BodyPoint& p) {
  return point_motion(plan, m, p.body, l.bodies[index(p.body)].points[index(p.point)].at).position;
}
inline math::Vec2 place_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& m,
                           std::string_view point) {
  return place_of(l, plan, m, point_named(l, point));
}

/// By how much the joints stand open: distances in m, angles times the size of the linkage. From the model
/// and the places of the bodies alone.
inline double open_joints(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& m) {
  double worst = 0;
  for (const LinkageJoint& j : l.joints) {
    const PartState<double> a = body_state(plan, m, j.first.body), b = body_state(plan, m, j.second.body);
    const auto turned = [&](int body) { return angle_of(body_state(plan, m, body).direction); };
    if (j.type == JointType::gear && j.curve) continue;
    if (j.type == JointType::gear) {
      const double carrier = turned(j.carrier);
      const double off =
          turned(j.second.body) - carrier - j.ratio * (turned(j.first.body) - carrier) - j.phase;
      // Angles are known up to whole turns, and so is a whole ratio times an angle.
      worst = std::max(worst, std::abs(std::remainder(off, 2 * std::acos(-1.0))) * plan.size);
      continue;
    }
    const math::Vec2 apart = place_of(l, plan, m, j.second) - place_of(l, plan, m, j.first);
    if (j.type == JointType::rack) {
      const math::Vec2 along = rotate(b.direction, math::unit(j.slide_second));
      const double turned_by = turned(j.first.body) - turned(j.second.body) - j.phase;
      // Angles are known up to whole turns.
      const double off = turned_by - dot(along, apart) / j.radius;
      worst = std::max({worst, std::abs(cross(along, apart) + j.radius),
                        std::abs(std::remainder(off, 2 * std::acos(-1.0)) * j.radius)});
      continue;
    }
    const math::Vec2 along = rotate(a.direction, math::unit(j.slide_first)),
                     other = rotate(b.direction, math::unit(j.slide_second));
    if (j.type == JointType::revolute || j.type == JointType::fixed) worst = std::max(worst, norm(apart));
    if (j.type == JointType::prismatic || j.type == JointType::pin_in_slot)
      worst = std::max(worst, std::abs(cross(along, apart)));
    if (j.type == JointType::prismatic || j.type == JointType::fixed)
      worst = std::max(worst, norm(other - along) * plan.size);
  }
  return worst;
}

/// Mass, centre and inertia of a body with what is attached to it, in its own frame.
inline BodyMass whole_mass(const LinkageBody& body) {
  BodyMass m = body.mass.value_or(BodyMass{});
  std::complex<double> moment = m.mass * m.centre;
  double inertia = m.inertia + m.mass * std::norm(m.centre), mass = m.mass;
  for (const AttachedMass& a : body.attached) {
    mass += a.mass;
    moment += a.mass * a.at;
    inertia += a.mass * std::norm(a.at);
  }
  const std::complex<double> centre = mass > 0 ? moment / mass : 0.0;
  return {mass, inertia - mass * std::norm(centre), centre};
}

/// The largest residual of Newton's and Euler's equations of each body for the reported joint forces, drives
/// and loads: the largest force (N) or moment (N m), from the model and the motion of the bodies alone.
inline double unbalance(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& m,
                        const LinkageForces& f) {
  double worst = 0;
  for (std::size_t b = 1; b < l.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    const BodyMass mass = whole_mass(l.bodies[b]);
    const PointMotion c = point_motion(plan, m, body, mass.centre);
    math::Vec2 force = mass.mass * (math::vec(l.gravity) - c.acceleration);
    double moment = -mass.inertia * body_state(plan, m, body).angular_acceleration;
    const auto add = [&](const math::Vec2& point, const math::Vec2& f1, double m1) {
      force = force + f1;
      moment += m1 + cross(point - c.position, f1);
    };
    for (std::size_t k = 0; k < l.joints.size(); ++k) {
      const LinkageJoint& j = l.joints[k];
      const JointReaction& r = f.joints[k];
      if (j.type == JointType::rack || (j.type == JointType::gear && std::isfinite(r.tangential))) {
        if (j.second.body == body) add(r.point, r.force, 0);
        if (j.first.body == body) add(r.point, -r.force, 0);
        continue;
      }
      if (j.type == JointType::gear) {
        if (j.second.body == body) moment += r.moment;
        if (j.first.body == body) moment -= j.ratio * r.moment;
        if (j.carrier == body) moment -= (1 - j.ratio) * r.moment;
        continue;
      }
      if (j.second.body == body) add(r.point, r.force, r.moment);
      if (j.first.body == body) add(r.point, -r.force, -r.moment);
    }
    for (std::size_t k = 0; k < f.strands.size(); ++k) {
      const JointReaction& r = f.strands[k];
      if (plan.strands[k].second == body) add(r.point, r.force, 0);
      if (plan.strands[k].first == body) add(r.point, -r.force, 0);
    }
    for (const AppliedLoad& load : f.loads)
      if (load.body == body) add(load.point, load.force, load.torque);
    worst = std::max({worst, std::abs(force.x), std::abs(force.y), std::abs(moment)});
  }
  return worst;
}

inline double largest_force(const LinkageForces& f) {
  double largest = 0;
  for (const JointReaction& r : f.joints) largest = std::max(largest, norm(r.force));
  return largest;
}

/// Kinetic energy, momentum and angular momentum about the global origin, from the bodies.
struct Momenta {
  double kinetic_energy = 0;
  math::Vec2 momentum{0, 0};
  double angular = 0;
  double mass = 0;
  math::Vec2 first_moment{0, 0};  ///< mass times place
};
inline Momenta momenta(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& m) {
  Momenta out;
  for (std::size_t b = 1; b < l.bodies.size(); ++b) {
    const BodyMass mass = whole_mass(l.bodies[b]);
    const PointMotion c = point_motion(plan, m, static_cast<int>(b), mass.centre);
    const double speed = body_state(plan, m, static_cast<int>(b)).speed;
    out.kinetic_energy += 0.5 * (mass.mass * dot(c.velocity, c.velocity) + mass.inertia * speed * speed);
    out.momentum = out.momentum + mass.mass * c.velocity;
    out.angular += mass.mass * cross(c.position, c.velocity) + mass.inertia * speed;
    out.mass += mass.mass;
    out.first_moment = out.first_moment + mass.mass * c.position;
  }
  return out;
}

/// Brings a motion that stands at `last` of the sample to another share of its way; general groups need the
/// way, and start from their start poses at share 0.
inline void go_to(const LinkageSample& s, const LinkagePlan& plan, double from, double to, LinkageMotion& m) {
  std::vector<double> a, b;
  for (std::size_t k = 0; k < s.from.size(); ++k) {
    a.push_back(s.from[k] + from * (s.to[k] - s.from[k]));
    b.push_back(s.from[k] + to * (s.to[k] - s.from[k]));
  }
  const FollowReport report = follow(plan, a, b, m);
  ASSERT_TRUE(report.arrived) << s.name << " at share " << from << " to " << to << ": "
                              << to_string(m.status);
}

}  // namespace linkwright::planar::test
