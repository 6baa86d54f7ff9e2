// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/corner_deviations.h"

#include <algorithm>
#include <cmath>

#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

/// Angle of the RR arm that brings it nearest to its place on the carrier.
double arm_angle(const CornerPlan& plan, const CarrierPose& pose, double rack) {
  for (const LinkConstants& link : plan.links) {
    if (link.type != LinkType::RR) continue;
    const Vec3 body = link.moved_by_rack ? link.body[0] + rack * plan.rack_direction : link.body[0];
    const auto across = [&](const Vec3& a) { return a - dot(a, link.axis) * link.axis; };
    const Vec3 from = across(plan.wheel.centre + link.offset[0] - link.body[0]),
               to = across(pose.centre + pose.rotation * link.offset[0] - body);
    return std::atan2(dot(link.axis, cross(from, to)), dot(from, to));
  }
  return 0;
}

struct Sums {
  double largest = 0, sum = 0;
  int count = 0;
  void add(double value) {
    largest = std::max(largest, std::abs(value));
    sum += std::abs(value);
    ++count;
  }
  Deviation deviation() const { return {largest, count > 0 ? sum / count : 0}; }
};

}  // namespace

ConstraintError constraint_error(const Suspension& suspension, const CarrierTargets& targets) {
  const CornerPlan plan = prepare_suspension(suspension);
  ConstraintError worst;
  for (std::size_t i = 0; i < targets.poses.size(); ++i) {
    const CarrierTarget& target = targets.poses[i];
    const CarrierPose pose{target.centre, target_rotation(targets, target)};
    const CornerPlace place{pose, arm_angle(plan, pose, target.rack)};
    const Misfit misfit = worst_misfit(plan, place, target.rack);
    double gap = std::abs(misfit.gap);
    // Directions of hinges, which are no gaps: what they do a metre away.
    CornerEquations equations;
    evaluate(plan, place, target.rack, Driver::wheel_centre_z, target.centre.z - plan.wheel.centre.z,
             equations);
    int link = misfit.link, row = 0;
    for (std::size_t l = 0; l < plan.links.size(); ++l) {
      const LinkType type = plan.links[l].type;
      const int rows = constraints(type) + (type == LinkType::RR ? 1 : 0);
      if (type == LinkType::R || type == LinkType::RR)
        for (int k = 3; k < rows; ++k)
          if (std::abs(equations.residual[static_cast<std::size_t>(row + k)]) > gap) {
            gap = std::abs(equations.residual[static_cast<std::size_t>(row + k)]);
            link = static_cast<int>(l);
          }
      row += rows;
    }
    if (worst.link < 0 || gap > worst.gap) worst = {gap, link, static_cast<int>(i)};
  }
  return worst;
}

PoseDeviations pose_deviations(const Suspension& suspension, const CarrierTargets& targets) {
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition start = reference_position(plan);
  PoseDeviations out;
  Sums x, y, toe, camber, carrier_pitch;
  for (const CarrierTarget& target : targets.poses) {
    const double travel = target.centre.z - suspension.wheel.centre.z;
    const CornerPosition at = start.status == Status::done
                                  ? solve_position(plan, Driver::wheel_centre_z, {travel, target.rack}, start)
                                  : start;
    if (at.status != Status::done) {
      out.status = at.status;
      ++out.missed;
      continue;
    }
    const WheelAngles angles = wheel_angles(suspension.side, suspension.wheel, at.place.carrier.rotation);
    x.add(at.place.carrier.centre.x - target.centre.x);
    y.add(at.place.carrier.centre.y - target.centre.y);
    toe.add(math::wrap_angle(angles.toe - target.angles.toe));
    camber.add(angles.camber - target.angles.camber);
    if (!std::isnan(target.angles.carrier_pitch))
      carrier_pitch.add(math::wrap_angle(angles.carrier_pitch - target.angles.carrier_pitch));
  }
  out.x = x.deviation(), out.y = y.deviation();
  out.toe = toe.deviation(), out.camber = camber.deviation(), out.carrier_pitch = carrier_pitch.deviation();
  return out;
}

}  // namespace linkwright::suspension
