// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

// Points of a body that are closer, as a share of the size of the linkage, are one.
constexpr double same_point = 1e-12;

// The links at a pin, and the joints between them, a tree.
struct LinksAtPin {
  std::vector<PartPoint> links;
  std::vector<std::size_t> joints;  // numbers in PlanDraft::joints

  int place_of(int part) const {
    for (std::size_t k = 0; k < links.size(); ++k)
      if (links[k].part == part) return static_cast<int>(k);
    return -1;
  }
};

bool same_place(const PlanDraft& d, const PartPoint& a, const PartPoint& b) {
  return a.part == b.part && norm(a.at - b.at) <= same_point * d.plan().size;
}

// All pins with the links that they hold. A driven pin is one only where that is asked for.
std::vector<LinksAtPin> pins_of(const PlanDraft& d, const std::vector<PartJoint>& joints, bool driven) {
  std::vector<LinksAtPin> pins;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const PartJoint& j = joints[k];
    // A block in a slot is a body of one point: no other joint can be there.
    if (j.slide || j.joint < 0 || d.model(j.joint).type != JointType::revolute || (j.input >= 0 && !driven))
      continue;
    LinksAtPin now{{j.first, j.second}, {k}};
    for (std::size_t p = pins.size(); p-- > 0;) {
      LinksAtPin& pin = pins[p];
      const bool here = std::any_of(pin.links.begin(), pin.links.end(), [&](const PartPoint& link) {
        return same_place(d, link, j.first) || same_place(d, link, j.second);
      });
      if (!here) continue;
      for (const PartPoint& link : pin.links)
        if (now.place_of(link.part) < 0) now.links.push_back(link);
      now.joints.insert(now.joints.end(), pin.joints.begin(), pin.joints.end());
      pins.erase(pins.begin() + static_cast<std::ptrdiff_t>(p));
    }
    std::sort(now.joints.begin(), now.joints.end());
    pins.push_back(std::move(now));
  }
  return pins;
}

// Passive pins of three links or more.
std::vector<LinksAtPin> pins_of_several(const PlanDraft& d) {
  std::vector<LinksAtPin> pins = pins_of(d, d.joints, false);
  std::erase_if(pins, [](const LinksAtPin& pin) {
    return pin.links.size() < 3 || pin.joints.size() + 1 != pin.links.size();  // joined twice: redundant
  });
  return pins;
}

// True for each link, by its place at the pin, that is on the side of `from` when joint number `without` is
// taken out.
std::vector<bool> side_of(const LinksAtPin& pin, const std::vector<PartJoint>& joints, std::size_t without,
                          int from) {
  std::vector<bool> side(pin.links.size(), false);
  side[at(pin.place_of(from))] = true;
  for (bool grown = true; std::exchange(grown, false);)
    for (const std::size_t k : pin.joints) {
      if (k == without) continue;
      const std::size_t a = at(pin.place_of(joints[k].first.part)),
                        b = at(pin.place_of(joints[k].second.part));
      if (side[a] != side[b]) side[a] = side[b] = grown = true;
    }
  return side;
}

// Pins a link to one that has its place, instead of a joint that joins two without.
bool pair_with_known(PlanDraft& d, const LinksAtPin& pin) {
  const auto known = std::find_if(pin.links.begin(), pin.links.end(),
                                  [&](const PartPoint& link) { return d.known[at(link.part)]; });
  if (known == pin.links.end()) return false;
  for (const std::size_t k : pin.joints) {
    PartJoint& j = d.joints[k];
    if (j.used || d.known[at(j.first.part)] || d.known[at(j.second.part)]) continue;
    const bool first_side = side_of(pin, d.joints, k, j.first.part)[at(pin.place_of(known->part))];
    (first_side ? j.first : j.second) = *known;
    return true;
  }
  return false;
}

// Pairs two links of which each is held by a joint elsewhere, so that they make a dyad: where no link at the
// pin has its place yet.
bool pair_for_dyad(PlanDraft& d, const LinksAtPin& pin) {
  if (std::any_of(pin.links.begin(), pin.links.end(),
                  [&](const PartPoint& link) { return d.known[at(link.part)]; }))
    return false;
  const auto held = [&](const PartPoint& link) {
    return !d.known[at(link.part)] && to_known(d, link.part) != nullptr;
  };
  for (std::size_t a = 0; a < pin.links.size(); ++a)
    for (std::size_t b = a + 1; b < pin.links.size(); ++b) {
      if (!held(pin.links[a]) || !held(pin.links[b])) continue;
      // Any free joint between one and the other may be taken; joined directly they were a dyad
      // already.
      for (const std::size_t k : pin.joints) {
        PartJoint& j = d.joints[k];
        if (j.used || side_of(pin, d.joints, k, pin.links[a].part)[b]) continue;
        j.first = pin.links[a];
        j.second = pin.links[b];
        return true;
      }
    }
  return false;
}

// The one pin that holds a wheel and its carrier; null when there is none or several.
const LinksAtPin* axis_of(const std::vector<LinksAtPin>& pins, int wheel, int carrier) {
  const LinksAtPin* found = nullptr;
  for (const LinksAtPin& pin : pins) {
    if (pin.place_of(wheel) < 0 || pin.place_of(carrier) < 0) continue;
    if (found) return nullptr;
    found = &pin;
  }
  return found;
}

}  // namespace

bool pair_otherwise(PlanDraft& d) {
  for (const LinksAtPin& pin : pins_of_several(d))
    if (pair_with_known(d, pin) || pair_for_dyad(d, pin)) return true;
  return false;
}

void find_shared_pins(PlanDraft& d) {
  for (const LinksAtPin& pin : pins_of_several(d)) {
    const auto other_pair = [&](std::size_t k) {
      return d.joints[k].first.part != d.written[k].first.part ||
             d.joints[k].second.part != d.written[k].second.part;
    };
    if (std::none_of(pin.joints.begin(), pin.joints.end(), other_pair)) continue;
    SharedPin out;
    for (const std::size_t i : pin.joints) {
      out.joints.push_back(d.written[i].joint);
      // A joint of the model carries what the links on the side of its second one need of the others.
      const std::vector<bool> side = side_of(pin, d.written, i, d.written[i].second.part);
      std::vector<double>& share = out.share.emplace_back();
      for (const std::size_t k : pin.joints)
        share.push_back(static_cast<double>(side[at(pin.place_of(d.joints[k].second.part))]) -
                        static_cast<double>(side[at(pin.place_of(d.joints[k].first.part))]));
    }
    d.plan().shared_pins.push_back(std::move(out));
  }
}

void find_meshes(PlanDraft& d) {
  constexpr double same_axis = 10 * tolerance::closure;  // in sizes of the linkage
  const std::vector<LinksAtPin> pins = pins_of(d, d.written, true);
  const auto at_pin = [](const LinksAtPin& pin, int part) { return pin.links[at(pin.place_of(part))]; };
  const auto find = [&](auto& gear, int joint) {
    const LinkageJoint& j = d.model(joint);
    const auto torque_alone = [&](const std::string& why) {
      d.plan().torque_gears.push_back(fmt::format("'{}': {}", j.name, why));
    };
    const int first = d.plan().bodies[at(j.first.body)].part,
              second = d.plan().bodies[at(j.second.body)].part, carrier = d.plan().bodies[at(j.carrier)].part;
    const double ratio = j.curve || j.geneva ? 0 : j.ratio;
    const LinksAtPin *a = axis_of(pins, first, carrier), *b = axis_of(pins, second, carrier);
    if (!a || !b)
      return torque_alone(fmt::format("'{}' has no single pin on '{}'",
                                      d.body_name(a ? j.second.body : j.first.body), d.body_name(j.carrier)));
    const double distance = norm(at_pin(*b, carrier).at - at_pin(*a, carrier).at);
    if (!(distance > same_axis * d.plan().size)) return torque_alone("both wheels turn about one axis");
    if (std::abs(1 - ratio) < tolerance::feasibility)
      return torque_alone(
          "a ratio of 1 is that of no two wheels that mesh; a belt has it, or an idler between them");
    gear.mesh = {.first = at_pin(*a, first),
                 .second = at_pin(*b, second),
                 .first_radius = -ratio / (1 - ratio) * distance,
                 .second_radius = distance / (1 - ratio),
                 .tangent = std::tan(j.pressure_angle)};
  };
  for (Group& g : d.plan().groups)
    for (PlanGear& gear : g.gears)
      if (gear.joint >= 0) find(gear, gear.joint);
  for (Group& g : d.plan().groups)
    for (PlanPair& pair : g.pairs)
      if (auto* curve = std::get_if<CurvePair>(&pair.kind)) find(*curve, pair.joint);
}

}  // namespace linkwright::planar
