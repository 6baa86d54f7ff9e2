// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

// "a", "a and b", "a, b and c", each in quotes.
std::string quoted_list(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + ("'" + names[i] + "'");
  return out;
}

int slot_of(const PlanDraft& d, const PartJoint& slide) {
  for (const PartJoint& joint : d.joints)
    if (!joint.slide && joint.first.part == slide.second.part) return joint.joint;
  return 0;
}
std::string driven_names(const PlanDraft& d) {
  std::vector<std::string> names;
  for (int k : d.linkage.driven) names.push_back(d.model(k).name);
  return quoted_list(names);
}

// "the linkage has 1 degree of freedom and 2 drives"
std::string freedoms_and_drives(const PlanDraft& d) {
  const int freedoms = mobility(d.linkage);
  const std::size_t drives = d.linkage.driven.size();
  return fmt::format("the linkage has {} degree{} of freedom and {} drive{}", freedoms,
                     freedoms == 1 ? "" : "s", drives, drives == 1 ? "" : "s");
}

// Reports why parts have no position.
void name_loose_parts(PlanDraft& d, const std::vector<int>& unknown) {
  const auto names = [&](const std::vector<int>& of) {
    std::vector<std::string> out;
    for (int p : of) out.push_back(d.plan().parts[at(p)]);
    return quoted_list(out);
  };
  // Components of the unknown parts; known parts are walls.
  std::vector<bool> seen(d.parts(), false);
  for (int p : unknown) {
    if (seen[at(p)]) continue;
    std::vector<int> component{p};
    seen[at(p)] = true;
    bool held = false;
    const auto join = [&](int there) {
      if (seen[at(there)] || d.known[at(there)]) return;
      seen[at(there)] = true;
      component.push_back(there);
    };
    for (std::size_t i = 0; i < component.size(); ++i) {
      for (const PartJoint& joint : d.joints)
        for (const auto& [here, there] :
             {std::pair{joint.first.part, joint.second.part}, std::pair{joint.second.part, joint.first.part}})
          if (here == component[i]) held = held || d.known[at(there)], join(there);
      for (const PartGear& gear : d.gears)
        if (gear.first == component[i] || gear.second == component[i]) join(gear.first), join(gear.second);
      for (const PartPair& pair : d.pairs)
        if (std::find(pair.parts.begin(), pair.parts.end(), component[i]) != pair.parts.end())
          for (const int p : pair.parts) join(p);
    }
    std::sort(component.begin(), component.end());
    std::vector<bool> chosen(d.parts(), false);
    for (int c : component) chosen[at(c)] = true;
    const int rows = equations_of(d, chosen);
    const int free = 3 * static_cast<int>(component.size()) - rows;
    const std::string key = "body." + d.plan().parts[at(component[0])];
    if (!held && component.size() == 1)
      d.error(key, fmt::format("{} is not joined to anything", names(component)),
              "join it to another body, or leave it out");
    else if (!held)
      d.error(key, fmt::format("{} are joined to each other but not to the ground", names(component)),
              "join one of them to the ground or to a body that is fixed to it");
    else if (free > 0)
      d.error(key,
              fmt::format("{} keep{} {} degree{} of freedom without a drive", names(component),
                          component.size() == 1 ? "s" : "", free, free == 1 ? "" : "s"),
              freedoms_and_drives(d) + ": drive one more joint, or add a joint");
    else if (free < 0 && d.linkage.driven.size() > 1 &&
             mobility(d.linkage) < static_cast<int>(d.linkage.driven.size()))
      d.error(
          "drive",
          fmt::format("two drives on one degree of freedom: with the drives of {} no freedom is left for {}",
                      driven_names(d), names(component)),
          freedoms_and_drives(d) + ": remove one drive");
    else if (free < 0)
      d.error(
          key,
          fmt::format("{} {} {} constraint{} too many: a rigid or overdetermined structure", names(component),
                      component.size() == 1 ? "has" : "have", -free, free == -1 ? "" : "s"),
          "leave out a joint or a drive");
    else
      d.error(key,
              fmt::format("{} {} constrained too much in one place and too little in another",
                          names(component), component.size() == 1 ? "is" : "are"),
              "look for a triangle of links that cannot move");
  }
}

}  // namespace

void find_problems(PlanDraft& d) {
  for (const PartJoint& joint : d.joints) {
    if (joint.used || !d.known[at(joint.first.part)] || !d.known[at(joint.second.part)]) continue;
    const int k = joint.joint >= 0 ? joint.joint : slot_of(d, joint);
    const LinkageJoint& j = d.model(k);
    if (joint.input >= 0)
      d.error(
          "drive",
          fmt::format(
              "two drives on one degree of freedom: '{}' and '{}', which joint '{}' would drive, are placed "
              "by other drives already",
              d.body_name(j.first.body), d.body_name(j.second.body), j.name),
          freedoms_and_drives(d) + ": remove one drive");
    else
      d.error("joint." + j.name,
              fmt::format("a redundant constraint: '{}' and '{}' are placed by other joints already, so the "
                          "linkage closes for special dimensions only",
                          d.body_name(j.first.body), d.body_name(j.second.body)),
              "leave the joint out, or one of the links beside it");
  }
  check_left_gears(d);
  check_left_pairs(d);
  if (const std::vector<int> unknown = unknown_parts(d); !unknown.empty()) name_loose_parts(d, unknown);
}

}  // namespace linkwright::planar
