// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

bool linked(const PlanDraft& d, int part, const std::vector<bool>& chosen) {
  return std::any_of(d.joints.begin(), d.joints.end(),
                     [&](const PartJoint& joint) {
                       return !joint.used && ((joint.first.part == part && chosen[at(joint.second.part)]) ||
                                              (joint.second.part == part && chosen[at(joint.first.part)]));
                     }) ||
         std::any_of(d.gears.begin(), d.gears.end(),
                     [&](const PartGear& gear) {
                       const auto parts = {gear.first, gear.second, gear.carrier};
                       return !gear.used && std::find(parts.begin(), parts.end(), part) != parts.end() &&
                              std::any_of(parts.begin(), parts.end(), [&](int p) { return chosen[at(p)]; });
                     }) ||
         std::any_of(d.pairs.begin(), d.pairs.end(), [&](const PartPair& pair) {
           return !pair.used && std::find(pair.parts.begin(), pair.parts.end(), part) != pair.parts.end() &&
                  std::any_of(pair.parts.begin(), pair.parts.end(), [&](int p) { return chosen[at(p)]; });
         });
}
// Smallest connected set of unknown parts with as many equations as unknowns, grown from its lowest part.
bool grow_set(const PlanDraft& d, std::vector<int>& set, std::vector<bool>& chosen, std::size_t size,
              int& tries) {
  if (set.size() == size) return equations_of(d, chosen) == 3 * static_cast<int>(size);
  for (int p = set.front() + 1; p < static_cast<int>(d.parts()); ++p) {
    if (d.known[at(p)] || chosen[at(p)] || !linked(d, p, chosen) || --tries < 0) continue;
    set.push_back(p);
    chosen[at(p)] = true;
    if (grow_set(d, set, chosen, size, tries)) return true;
    set.pop_back();
    chosen[at(p)] = false;
  }
  return false;
}

void add_general_group(PlanDraft& d, std::vector<int> set, const std::vector<bool>& chosen) {
  std::sort(set.begin(), set.end());
  Group g{.kind = GeneralGroup{}, .parts = set};
  for (PartJoint& joint : d.joints) {
    if (!holds_chosen(d, joint, chosen)) continue;
    g.joints.push_back(chained(joint, joint.first.part));
    joint.used = true;
  }
  for (PartGear& gear : d.gears) {
    if (!holds_chosen(d, gear, chosen)) continue;
    g.gears.push_back(gear_of_group(d, gear, true));
    gear.used = true;
  }
  for (PartPair& pair : d.pairs) {
    if (!holds_chosen(d, pair, chosen)) continue;
    g.pairs.push_back(pair.pair);
    pair.used = true;
  }
  std::vector<math::Pose>& start = std::get<GeneralGroup>(g.kind).start;
  for (int p : set)
    if (d.start[at(p)]) start.push_back(*d.start[at(p)]);
  if (start.size() != set.size()) start.clear();
  place_group(d, std::move(g));
}

}  // namespace

bool holds_chosen(const PlanDraft& d, const PartJoint& joint, const std::vector<bool>& chosen) {
  const int a = joint.first.part, b = joint.second.part;
  return !joint.used &&
         ((chosen[at(a)] && (chosen[at(b)] || d.known[at(b)])) || (chosen[at(b)] && d.known[at(a)]));
}

bool holds_chosen(const PlanDraft& d, const PartGear& gear, const std::vector<bool>& chosen) {
  const auto parts = {gear.first, gear.second, gear.carrier};
  return !gear.used && std::any_of(parts.begin(), parts.end(), [&](int p) { return chosen[at(p)]; }) &&
         std::all_of(parts.begin(), parts.end(), [&](int p) { return chosen[at(p)] || d.known[at(p)]; });
}

bool holds_chosen(const PlanDraft& d, const PartPair& pair, const std::vector<bool>& chosen) {
  return !pair.used &&
         std::any_of(pair.parts.begin(), pair.parts.end(), [&](int p) { return chosen[at(p)]; }) &&
         std::all_of(pair.parts.begin(), pair.parts.end(),
                     [&](int p) { return chosen[at(p)] || d.known[at(p)]; });
}

int equations_of(const PlanDraft& d, const std::vector<bool>& chosen) {
  int count = 0;
  for (const PartJoint& joint : d.joints)
    if (holds_chosen(d, joint, chosen)) count += joint.input >= 0 ? 3 : 2;
  for (const PartGear& gear : d.gears) count += holds_chosen(d, gear, chosen);
  for (const PartPair& pair : d.pairs) count += holds_chosen(d, pair, chosen);
  return count;
}

std::vector<int> unknown_parts(const PlanDraft& d) {
  std::vector<int> unknown;
  for (int p = 0; p < static_cast<int>(d.parts()); ++p)
    if (!d.known[at(p)]) unknown.push_back(p);
  return unknown;
}

bool find_general_group(PlanDraft& d) {
  const std::vector<int> unknown = unknown_parts(d);
  int tries = 200000;  // the whole rest is tried in any case
  for (std::size_t size = 1; size <= unknown.size(); ++size) {
    for (int first : unknown) {
      std::vector<int> set{first};
      std::vector<bool> chosen(d.parts(), false);
      chosen[at(first)] = true;
      if (size == unknown.size() && first == unknown.front()) {
        set = unknown;
        for (int p : unknown) chosen[at(p)] = true;
        if (equations_of(d, chosen) != 3 * static_cast<int>(size)) continue;
      } else if (!grow_set(d, set, chosen, size, tries)) {
        continue;
      }
      add_general_group(d, set, chosen);
      return true;
    }
  }
  return false;
}

void merge_groups(PlanDraft& d) {
  d.plan().groups.clear();
  d.joints = d.written;
  for (PartGear& gear : d.gears)
    gear.used = gear.joint >= 0 && std::find(d.plan().redundant_gears.begin(), d.plan().redundant_gears.end(),
                                             gear.joint) != d.plan().redundant_gears.end();
  for (PartPair& pair : d.pairs) pair.used = false;
  d.plan().shared_pins.clear();
  std::vector<bool> chosen(d.parts(), true);
  chosen[0] = false;
  d.known.assign(d.parts(), false);
  d.known[0] = true;
  std::vector<int> all(d.parts() - 1);
  std::iota(all.begin(), all.end(), 1);
  add_general_group(d, std::move(all), chosen);
}

}  // namespace linkwright::planar
