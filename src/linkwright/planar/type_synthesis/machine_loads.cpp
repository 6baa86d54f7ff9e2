// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/machine_loads.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/linkage/sweep.h"

namespace linkwright::planar {

void add_loads(FoundLinkage& found, const MachineLoads& loads) {
  Linkage& linkage = found.linkage;
  set_uniform_all(linkage, loads.mass_per_metre);
  linkage.gravity = {0, -loads.gravity};
  if (loads.force != 0.0)
    linkage.forces.push_back(
        {.name = "load", .point = point_named(linkage, found.traced), .force = loads.force});
  if (loads.torque != 0)
    linkage.torques.push_back(
        {.name = "load torque",
         .body = body_index(linkage, std::string_view(found.traced).substr(0, found.traced.find('.'))),
         .torque = loads.torque});
}

PeakForces peak_forces(const FoundLinkage& loaded, double crank_speed, std::span<const double> crank) {
  const Linkage& linkage = loaded.linkage;
  const PlanResult planned = plan_linkage(linkage);
  if (!planned.problems.empty()) return {};
  LinkageMotion motion(planned.plan);
  LinkageForces forces;
  PeakForces out{0, 0};
  for (const double angle : crank) {
    const InputMotion input{angle, crank_speed, 0};
    solve_motion(planned.plan, std::span(&input, 1), motion);
    solve_forces(linkage, planned.plan, motion, 0, angle, forces);
    if (forces.status != Status::done) return {};
    out.drive_torque = std::max(out.drive_torque, std::abs(forces.drives[0]));
    for (const JointReaction& joint : forces.joints)
      if (const double size = norm(joint.force); size > out.joint_force) out.joint_force = size;
  }
  return out;
}

bool sample_forces(const FoundLinkage& loaded, double crank_speed, std::span<const double> crank,
                   ForceSamples& out) {
  PlanResult planned = plan_linkage(loaded.linkage);
  if (!planned.problems.empty()) return false;
  LinkageSweep sweep(loaded.linkage, std::move(planned.plan), {.rates = true, .forces = true});
  const double speed[] = {crank_speed};
  const SweepInput input{.value = crank, .rate = speed, .acceleration = {}};
  sweep.run(std::span(&input, 1));
  const auto status = sweep.status();
  if (!std::all_of(status.begin(), status.end(), [](Status s) { return s == Status::done; })) return false;
  out.count = crank.size();
  out.joint_force.clear(), out.drive_torque.clear();
  for (std::size_t j = 0; j < loaded.linkage.joints.size(); ++j) {
    const auto x = sweep.joint(static_cast<int>(j), JointRow::force_x),
               y = sweep.joint(static_cast<int>(j), JointRow::force_y);
    for (std::size_t k = 0; k < crank.size(); ++k) {
      const double force = std::hypot(x[k], y[k]);
      out.joint_force.push_back(std::isnan(force) ? 0 : force);
    }
  }
  for (const double torque : sweep.drive(0)) out.drive_torque.push_back(std::abs(torque));
  return true;
}

}  // namespace linkwright::planar
