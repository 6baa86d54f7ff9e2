// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/springs.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::suspension {

WheelRate wheel_rate(const TravelRates& length, const SpringForce& force) {
  WheelRate out;
  if (!std::isfinite(length.ratio) || !std::isfinite(length.by_travel)) {
    out.status = Status::singular;
    return out;
  }
  out.motion_ratio = -length.ratio;
  out.motion_ratio_by_travel = -length.by_travel;
  out.spring_force = force.force;
  out.wheel_force = out.spring_force * out.motion_ratio;
  out.by_stiffness = force.stiffness * out.motion_ratio * out.motion_ratio;
  out.by_motion_ratio = out.spring_force * out.motion_ratio_by_travel;
  out.rate = out.by_stiffness + out.by_motion_ratio;
  return out;
}

WheelRate wheel_rate(const DerivativePlan& plan, const CornerPosition& position, const SpringLaw& law) {
  LINKWRIGHT_REQUIRE(plan.plan.spring, "the suspension has no spring");
  const CornerMotions motions = corner_motions(plan, position);
  const double compression = -driver_value(plan.plan, position.place, position.input.rack, Driver::spring);
  return wheel_rate(*motions.spring, force_of(law, compression));
}

}  // namespace linkwright::suspension
