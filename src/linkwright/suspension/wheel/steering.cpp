// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/suspension/wheel/axle.h"

namespace linkwright::suspension {
namespace {

/// Toe by a metre of rack (rad) below which the rack does not steer.
constexpr double no_steering = 1e-9;

}  // namespace

bool is_steered(const CornerPlan& plan) {
  return std::any_of(plan.links.begin(), plan.links.end(),
                     [](const auto& link) { return link.moved_by_rack; });
}

std::optional<SteeringParameters> steering_parameters(const CornerPlan& plan, const CornerPosition& position,
                                                      Driver lock) {
  LINKWRIGHT_REQUIRE(lock != Driver::spring || plan.spring,
                     "the spring is held, and the suspension has none");
  if (!is_steered(plan)) return std::nullopt;
  const CornerRates rates = solve_rates(plan, position, Driver::wheel_centre_z);
  if (rates.status != Status::done) return std::nullopt;
  const Twist twist = steering_twist(plan, position, rates, lock);
  const WheelAngles angles = wheel_angles(plan.side, plan.wheel, position.place.carrier.rotation);
  const WheelAngles by_rack = angle_rates(plan.side, angles, twist.turning);
  if (!(std::abs(by_rack.toe) > no_steering)) return std::nullopt;
  const ContactVelocity speed =
      contact_velocity(plan.side, plan.wheel.tyre_diameter, angles, twist.velocity, twist.turning);
  const double outboard = plan.side == Side::left ? 1 : -1, toe = by_rack.toe;
  return SteeringParameters{.lock = lock,
                            .toe_by_rack = toe,
                            .steer_by_rack = -outboard * toe,
                            .camber_by_toe = by_rack.camber / toe,
                            .carrier_pitch_by_toe = by_rack.carrier_pitch / toe,
                            .brake_arm = speed.on_carrier.x / toe,
                            .drive_arm = speed.geometric.x / toe,
                            .lateral_arm = outboard * speed.on_carrier.y / toe,
                            .load_arm = speed.on_carrier.z / toe,
                            .contact_rise_by_rack = speed.geometric.z};
}

double steering_ratio(double steer_by_rack, double rack_per_turn) {
  LINKWRIGHT_REQUIRE(rack_per_turn > 0, "rack travel by a turn of the pinion {} m, needs to be positive",
                     rack_per_turn);
  return 2 * pi / (std::abs(steer_by_rack) * rack_per_turn);
}

}  // namespace linkwright::suspension
