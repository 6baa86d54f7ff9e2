// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/springs.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/compliance/compliance.h"

namespace linkwright::suspension {

WheelRate wheel_rate(const Suspension& suspension, const CornerPlan& plan, const CornerPosition& position,
                     const SpringLaw& law) {
  LINKWRIGHT_REQUIRE(plan.spring, "the suspension has no spring");
  LINKWRIGHT_REQUIRE(law.stiffness >= 0 && std::isfinite(law.stiffness), "stiffness {} N/m", law.stiffness);
  const double rack = position.input.rack;
  WheelRate out;
  out.spring_force = law.preload - law.stiffness * driver_value(plan, position.place, rack, Driver::spring);
  const CornerRates rates = solve_rates(plan, position, Driver::wheel_centre_z);
  out.status = rates.status;
  if (out.status != Status::done) return out;
  out.motion_ratio = -driver_rate(plan, position.place, rack, Driver::spring, rates.bump, 0);
  // A suspension with rigid joints, a spring of some N/m and 1 N of force in it: what its wheel yields beside
  // k i^2 is the change of the motion ratio. The spring is stiff enough to outweigh that change.
  constexpr double stiffness = 100, force = 1;
  const PointLoad load{position.place.carrier.centre, {0, 0, force * out.motion_ratio}};
  const Compliance found =
      solve_compliance(suspension, position.place, rack, {.spring = stiffness}, Support::spring, load);
  out.status = found.status;
  if (out.status != Status::done) return out;
  out.motion_ratio_by_travel =
      (1 / found.at_centre[2][2] - stiffness * out.motion_ratio * out.motion_ratio) / force;
  out.wheel_force = out.spring_force * out.motion_ratio;
  out.by_stiffness = law.stiffness * out.motion_ratio * out.motion_ratio;
  out.by_motion_ratio = out.spring_force * out.motion_ratio_by_travel;
  out.rate = out.by_stiffness + out.by_motion_ratio;
  return out;
}

}  // namespace linkwright::suspension
