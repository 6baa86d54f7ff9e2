// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

PlanLink closed_form_link(const math::Vec2& vector) {
  PlanLink link;
  link.vector = vector;
  link.square = dot(vector, vector);
  link.length = std::sqrt(link.square);
  if (link.square > 0) link.inverse = (1 / link.square) * conjugate(vector);
  return link;
}

// The dyad of three joints in the order of the chain, the pin first where one end is a slide.
Dyad dyad_of(const PlanJoint& j1, const PlanJoint& j2, const PlanJoint& j3) {
  Dyad dyad;
  if (j2.slide)
    dyad.type = j3.slide ? DyadType::rpp : DyadType::rpr;
  else
    dyad.type = j1.slide ? DyadType::prp : j3.slide ? DyadType::rrp : DyadType::rrr;
  math::Vec2 first = j2.before.at - j1.after.at, second = j2.after.at - j3.before.at;
  if (dyad.type == DyadType::rpr) {
    first = rotate_inverse(j2.before.direction, first);
    second = rotate_inverse(j2.after.direction, second);
  }
  dyad.first = closed_form_link(first);
  dyad.second = closed_form_link(second);
  if (dyad.type == DyadType::rrr) dyad.per_length = 1 / (dyad.first.length * dyad.second.length);
  if (dyad.type == DyadType::rrp) dyad.per_length = 1 / dyad.first.length;
  return dyad;
}

bool find_driver(PlanDraft& d) {
  for (PartJoint& joint : d.joints) {
    if (joint.used || joint.input < 0 || d.known[at(joint.first.part)] == d.known[at(joint.second.part)])
      continue;
    const bool from_first = d.known[at(joint.first.part)];
    const int base = from_first ? joint.first.part : joint.second.part;
    Group g{.kind = Driver{}};
    g.joints = {chained(joint, base)};
    g.parts = {g.joints[0].after.part};
    if (d.angles[at(base)]) {
      DrivenAngle a = *d.angles[at(base)];
      a.angle += angle_of(g.joints[0].before.direction) - angle_of(g.joints[0].after.direction);
      if (!joint.slide) a.gains[at(joint.input)] += from_first ? 1 : -1;
      d.angles[at(g.parts[0])] = std::move(a);
    }
    joint.used = true;
    place_group(d, std::move(g));
    return true;
  }
  return false;
}

bool find_dyad(PlanDraft& d) {
  for (PartJoint& inner : d.joints) {
    if (inner.used || inner.input >= 0) continue;
    int i = inner.first.part, k = inner.second.part;
    if (d.known[at(i)] || d.known[at(k)]) continue;
    if (i > k) std::swap(i, k);
    PartJoint *outer1 = to_known(d, i), *outer3 = to_known(d, k);
    if (!outer1 || !outer3) continue;
    const int slides = outer1->slide + inner.slide + outer3->slide;
    if (slides == 3) continue;  // no pin: nothing determines the joint displacement of the two
    // Order of the chain: the pin first where one end is a slide.
    if (outer1->slide && !outer3->slide) std::swap(i, k), std::swap(outer1, outer3);
    const auto other = [](const PartJoint& joint, int part) {
      return joint.first.part == part ? joint.second.part : joint.first.part;
    };
    const PlanJoint j1 = chained(*outer1, other(*outer1, i)), j2 = chained(inner, i),
                    j3 = chained(*outer3, k);
    outer1->used = inner.used = outer3->used = true;
    place_group(d, {.kind = dyad_of(j1, j2, j3), .parts = {i, k}, .joints = {j1, j2, j3}});
    return true;
  }
  return false;
}

// Two bodies with a drive between them, pinned to a known part and to an arm on another known pin.
bool find_triangle(PlanDraft& d) {
  for (PartJoint& inner : d.joints) {
    if (inner.used || inner.input < 0) continue;
    for (const bool swapped : {false, true}) {
      const int x = swapped ? inner.second.part : inner.first.part,
                y = swapped ? inner.first.part : inner.second.part;
      PartJoint* foot = d.known[at(x)] || d.known[at(y)] ? nullptr : to_known(d, x);
      if (!foot || foot->slide) continue;
      for (PartJoint& tip : d.joints) {
        if (tip.used || tip.slide || tip.input >= 0 || (tip.first.part != y && tip.second.part != y))
          continue;
        const int z = tip.first.part == y ? tip.second.part : tip.first.part;
        PartJoint* base = z == x || d.known[at(z)] ? nullptr : to_known(d, z);
        if (!base || base->slide) continue;
        std::vector<bool> chosen(d.parts(), false);
        chosen[at(x)] = chosen[at(y)] = chosen[at(z)] = true;
        if (equations_of(d, chosen) != 9) continue;
        const int known = foot->first.part == x ? foot->second.part : foot->first.part;
        const PlanJoint j3 = chained(tip, y), j4 = chained(*base, z);
        foot->used = inner.used = tip.used = base->used = true;
        place_group(d, {.kind = Triangle{closed_form_link(j3.after.at - j4.before.at)},
                        .parts = {x, y, z},
                        .joints = {chained(*foot, known), chained(inner, x), j3, j4}});
        return true;
      }
    }
  }
  return false;
}

}  // namespace

PartJoint* to_known(PlanDraft& d, int part) {
  for (PartJoint& joint : d.joints) {
    if (joint.used || joint.input >= 0) continue;
    if (joint.first.part == part && d.known[at(joint.second.part)]) return &joint;
    if (joint.second.part == part && d.known[at(joint.first.part)]) return &joint;
  }
  return nullptr;
}
PlanJoint chained(const PartJoint& joint, int before) {
  const bool reversed = joint.first.part != before;
  return {joint.slide,
          reversed,
          joint.joint,
          joint.input,
          reversed ? joint.second : joint.first,
          reversed ? joint.first : joint.second};
}

void place_group(PlanDraft& d, Group group) {
  std::vector<std::string> names;
  for (int p : group.parts) {
    d.known[at(p)] = true;
    d.plan().group_of_part[at(p)] = static_cast<int>(d.plan().groups.size());
    names.push_back(d.plan().parts[at(p)]);
  }
  for (const std::string& n : names) group.name += (group.name.empty() ? "" : " + ") + n;
  d.plan().groups.push_back(std::move(group));
}

void find_groups(PlanDraft& d) {
  d.known.assign(d.parts(), false);
  d.known[0] = true;
  d.plan().group_of_part.assign(d.parts(), -1);
  d.angles.assign(d.parts(), std::nullopt);
  d.angles[0] = DrivenAngle{0, std::vector<double>(d.linkage.driven.size(), 0.0)};
  d.written = d.joints;
  while (find_driver(d) || find_train(d) || find_follower(d) || find_dyad(d) || pair_otherwise(d) ||
         find_triangle(d) || find_general_group(d)) {
  }
  find_shared_pins(d);
}

}  // namespace linkwright::planar
