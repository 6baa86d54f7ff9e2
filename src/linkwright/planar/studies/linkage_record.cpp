// SPDX-License-Identifier: BSD-3-Clause
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/open_pose.h"
#include "linkwright/planar/studies/linkage_scene.h"

// The data of a position for a scene.
namespace linkwright::planar {

LinkageRecord record_of(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                        const LinkageForces* forces, double input) {
  LinkageRecord r{.status = motion.status, .input = input};
  if (motion.status != Status::done && motion.status != Status::singular) return r;
  for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b)
    r.bodies.push_back(body_state(plan, motion, b));
  if (forces && forces->status == Status::done) {
    r.joints = forces->joints;
    r.cams = forces->cams;
    r.drives = forces->drives;
    r.shaking_force = forces->shaking_force;
    // Behind those of springs, and of the two bodies of a torque the first.
    const auto& loads = forces->loads;
    const std::size_t springs = 2 * (linkage.springs.size() + linkage.torsion_springs.size());
    const std::size_t torques = springs + linkage.forces.size();
    if (loads.size() >= torques + 2 * linkage.torques.size()) {
      r.loads.assign(loads.begin() + springs, loads.begin() + torques);
      for (std::size_t k = 0; k < linkage.torques.size(); ++k) r.loads.push_back(loads[torques + 2 * k]);
    }
  }
  return r;
}

LinkageRecord open_record_of(const Linkage& linkage, const LinkagePlan& plan,
                             std::span<const InputMotion> inputs, LinkageMotion& motion, double input) {
  LinkageRecord r{.status = motion.status, .input = input};
  if (motion.status != Status::no_assembly || motion.failed_group < 0) return r;
  const auto ends = lay_open(plan, inputs, motion);
  std::vector<bool> placed(plan.parts.size(), false);
  placed[0] = true;
  for (std::size_t k = 0; k < at(motion.failed_group) + (ends ? 1 : 0); ++k)
    for (const int part : plan.groups[k].parts) placed[at(part)] = true;
  constexpr PartState<double> nowhere{{nan, nan}, {nan, nan}, {nan, nan}, nan, {nan, nan}, nan};
  for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b)
    r.bodies.push_back(placed[at(plan.bodies[at(b)].part)] ? body_state(plan, motion, b) : nowhere);
  if (ends) r.gap = *ends, r.open_group = motion.failed_group;
  return r;
}

}  // namespace linkwright::planar
