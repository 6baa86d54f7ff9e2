// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/detail/plan_draft.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

std::string name_or_number(const PlanDraft& d, int body) {
  return body >= 0 && body < static_cast<int>(d.linkage.bodies.size()) ? d.body_name(body)
                                                                       : std::to_string(body);
}
int part_of_body(const PlanDraft& d, int body) {
  return body >= 0 && body < static_cast<int>(d.linkage.bodies.size()) ? d.plan().bodies[at(body)].part : -2;
}
bool is_block(const PlanDraft& d, int part) { return d.plan().parts[at(part)].starts_with("block of "); }

std::optional<double> drawn_mode(const PlanDraft& d, const Group& g) {
  for (const PlanJoint& j : g.joints)
    if (!d.start[at(j.before.part)] || !d.start[at(j.after.part)]) return {};
  const auto there = [&](const PartPoint& p) {
    return math::vec(math::transform(*d.start[at(p.part)], number(p.at)));
  };
  const auto along = [&](const PartPoint& p) {
    return rotate(math::unit(d.start[at(p.part)]->angle), p.direction);
  };
  return mode_side(g, there, along) < 0 ? -1.0 : 1.0;
}

}  // namespace

void find_modes(PlanDraft& d) {
  std::vector<bool> used(d.linkage.modes.size(), false);
  for (Group& g : d.plan().groups) {
    if (!traits_of(g).has_modes) continue;
    if (const auto shown = drawn_mode(d, g)) g.mode = *shown, g.mode_given = true;
    for (std::size_t i = 0; i < d.linkage.modes.size(); ++i) {
      const DyadMode& m = d.linkage.modes[i];
      const int a = part_of_body(d, m.first), b = part_of_body(d, m.second);
      const bool driven = g.as<Triangle>();
      const int first = driven && (a == g.parts[1] || b == g.parts[1]) ? g.parts[1] : g.parts[0],
                second = g.parts.back();
      const bool straight = a == first && (b == second || (a == b && is_block(d, second)));
      const bool swapped = (a == second && b == first) || (a == b && a == second && is_block(d, first));
      if (!straight && !swapped) continue;
      used[i] = true;
      // The sign of RRP goes with the direction of its guide, the others with the order of the two parts.
      const Dyad* dyad = g.as<Dyad>();
      g.mode = sign(m.mode) * (swapped && !(dyad && dyad->type == DyadType::rrp) ? -1 : 1);
      g.mode_given = true;
    }
  }
  for (std::size_t i = 0; i < d.linkage.modes.size(); ++i)
    if (!used[i]) {
      std::string dyads;
      for (const Group& g : d.plan().groups)
        if (traits_of(g).has_modes) dyads += (dyads.empty() ? "" : ", ") + g.name;
      d.error("assembly",
              fmt::format("'{}' and '{}' are not a pair with two assembly modes",
                          name_or_number(d, d.linkage.modes[i].first),
                          name_or_number(d, d.linkage.modes[i].second)),
              dyads.empty() ? "this linkage has no such pair" : "these are: " + dyads);
    }
}

void find_drawn_inputs(PlanDraft& d) {
  std::vector<double> values(d.linkage.driven.size());
  for (const PartJoint& joint : d.joints) {
    if (joint.input < 0) continue;
    const auto &first = d.start[at(joint.first.part)], &second = d.start[at(joint.second.part)];
    if (!first || !second) return;
    const math::Vec2 along = rotate(math::unit(first->angle), joint.first.direction),
                     other = rotate(math::unit(second->angle), joint.second.direction),
                     way = math::vec(math::transform(*second, number(joint.second.at))) -
                           math::vec(math::transform(*first, number(joint.first.at)));
    values[at(joint.input)] = joint.slide ? dot(along, way) : angle_of(rotate_inverse(along, other));
  }
  d.plan().drawn_inputs = std::move(values);
}

}  // namespace linkwright::planar
