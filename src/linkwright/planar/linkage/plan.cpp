// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/plan.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {

bool LinkagePlan::closed_form() const {
  return std::none_of(groups.begin(), groups.end(), [](const Group& g) { return !traits_of(g).closed_form; });
}

std::vector<PartMass> part_masses(const Linkage& linkage, std::span<const BodyOnPart> bodies,
                                  std::size_t parts) {
  std::vector<PartMass> masses(parts);
  for (std::size_t i = 1; i < linkage.bodies.size(); ++i) {
    const LinkageBody& body = linkage.bodies[i];
    const BodyOnPart& on = bodies[i];
    PartMass& m = masses[at(on.part)];
    const auto add = [&](double mass, double inertia, const math::Vec2& centre) {
      const math::Vec2 c = on.origin + rotate(on.turn, centre);
      m.mass += mass;
      m.moment = m.moment + mass * c;
      m.inertia += inertia + mass * dot(c, c);
    };
    if (body.mass) add(body.mass->mass, body.mass->inertia, math::vec(body.mass->centre));
    for (const AttachedMass& a : body.attached) add(a.mass, 0, math::vec(a.at));
  }
  return masses;
}

int mobility(const Linkage& linkage) {
  int freedoms = 3 * (static_cast<int>(linkage.bodies.size()) - 1);
  for (const LinkageJoint& j : linkage.joints)
    freedoms -= j.type == JointType::fixed                                        ? 3
                : j.type == JointType::revolute || j.type == JointType::prismatic ? 2
                                                                                  : 1;
  freedoms -= static_cast<int>(linkage.cams.size());
  for (const Belt& b : linkage.belts)
    freedoms -= static_cast<int>(b.wheels.size()) - (b.closed && b.carrier < 0 ? 0 : 1);
  return freedoms;
}

void find_twists(PlanDraft& d) {
  const auto add = [&](int first_body, int second_body, double free) {
    const BodyOnPart &a = d.plan().bodies[at(first_body)], &b = d.plan().bodies[at(second_body)];
    PlanTwist twist{a.part, b.part, rotate_inverse(a.turn, b.turn)};
    twist.free = free;
    const auto &first = d.angles[at(a.part)], &second = d.angles[at(b.part)];
    if (first && second) {
      twist.counted = true;
      twist.angle = math::wrap_angle(second->angle - first->angle + angle_of(twist.turn));
      for (std::size_t i = 0; i < first->gains.size(); ++i)
        twist.gains.push_back(second->gains[i] - first->gains[i]);
    }
    d.plan().twists.push_back(std::move(twist));
  };
  for (const TorsionSpring& s : d.linkage.torsion_springs) add(s.first, s.second, s.free_angle);
  for (const JointStop& s : d.linkage.stops) {
    const LinkageJoint& j = d.linkage.joints[at(s.joint)];
    // The joint begins up to nearly a turn off its stop, on the side on which it can be.
    constexpr double beyond = 0.1;
    if (j.type == JointType::revolute)
      add(j.first.body, j.second.body, s.limit + s.side * (pi - beyond));
    else
      d.plan().twists.push_back({.counted = true, .gains = {}});
  }
  for (const int k : d.linkage.counted_pins)
    add(d.linkage.joints[at(k)].first.body, d.linkage.joints[at(k)].second.body, 0);
}

PlanResult plan_linkage(const Linkage& linkage, PlanRoute route) {
  PlanDraft d{.linkage = linkage};
  d.result.problems = check(linkage);
  if (!d.good()) return std::move(d.result);
  d.plan().size = size_of(linkage);
  find_parts(d);
  if (!d.good()) return std::move(d.result);
  find_groups(d);
  find_problems(d);
  if (d.good()) find_modes(d);
  if (d.good()) find_drawn_inputs(d);
  if (d.good()) find_twists(d);
  d.plan().turned = d.angles;
  if (d.good() && route == PlanRoute::all_at_once) merge_groups(d);
  if (d.good()) find_meshes(d);
  return std::move(d.result);
}

}  // namespace linkwright::planar
