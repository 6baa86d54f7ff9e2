// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/parameters.h"

#include "linkwright/suspension/wheel/detail/parameters_kernel.h"

namespace linkwright::suspension {

Twist steering_twist(const CornerPlan& plan, const CornerPosition& position, const CornerRates& rates,
                     Driver lock) {
  return kernel::steering_twist(plan, position.place, position.input.rack, rates.bump, rates.steer, lock);
}

std::optional<SteeringAxis> steering_axis(Side side, const Vec3& centre, const Vec3& contact, double toe,
                                          const Twist& steering, Driver lock) {
  return kernel::steering_axis(side, centre, contact, toe, steering, lock);
}

WheelParameters wheel_parameters(const CornerPlan& plan, const CornerPosition& position) {
  const double rack = position.input.rack;
  WheelParameters out = kernel::parameters_at_rest(plan, position.place, rack);
  kernel::add_constructions(plan, position.place, rack, out);
  const CornerRates rates = solve_rates(plan, position, Driver::wheel_centre_z);
  out.status = rates.status;
  if (out.status == Status::done) kernel::add_rates(plan, position.place, rack, rates.bump, rates.steer, out);
  return out;
}

}  // namespace linkwright::suspension
