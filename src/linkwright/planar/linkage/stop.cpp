// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/stop.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/quality.h"

namespace linkwright::planar {

StopMotion stop_motion(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                       std::size_t stop) {
  const JointStop& s = l.stops[stop];
  JointMotion joint = joint_motion(l, plan, motion, s.joint);
  double limit = s.limit;
  if (l.joints[at(s.joint)].type == JointType::revolute) {
    const std::size_t k = l.torsion_springs.size() + stop;
    const PlanTwist& twist = plan.twists[k];
    joint.value = motion.twists[k];
    if (!twist.counted) limit -= full_turn * std::round(twist.free / full_turn);
  }
  return {s.side * (joint.value - limit), s.side * joint.rate, s.side * joint.acceleration};
}

double stop_effort(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, std::size_t stop) {
  const JointStop& s = l.stops[stop];
  const bool known = stop < motion.stops.size();
  if (!s.stiffness) return known ? motion.stops[stop] : 0;
  const StopMotion now = stop_motion(l, plan, motion, stop);
  const double push = -*s.stiffness * now.gap - s.damping * now.rate;
  if (known) return motion.stops[stop] > 0 ? push : 0;
  return now.gap < 0 ? std::max(0.0, push) : 0;
}

void add_stop_loads(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, std::size_t stop,
                    std::vector<AppliedLoad>& loads) {
  const double effort = l.stops[stop].side * stop_effort(l, plan, motion, stop);
  if (effort == 0) return;
  const LinkageJoint& j = l.joints[at(l.stops[stop].joint)];
  const math::Vec2 there = point_motion(l, plan, motion, j.second).position;
  math::Vec2 force{0, 0};
  double torque = 0;
  if (j.type == JointType::revolute)
    torque = effort;
  else
    force = effort * rotate(body_state(plan, motion, j.first.body).direction, math::unit(j.slide_first));
  loads.push_back({j.second.body, there, force, torque});
  loads.push_back({j.first.body, there, -force, -torque});
}

int passed_stop(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, double slack) {
  for (std::size_t k = 0; k < l.stops.size(); ++k) {
    const bool pin = l.joints[at(l.stops[k].joint)].type == JointType::revolute;
    if (!l.stops[k].stiffness && stop_motion(l, plan, motion, k).gap < -slack * (pin ? 1 : plan.size))
      return static_cast<int>(k);
  }
  return -1;
}

}  // namespace linkwright::planar
