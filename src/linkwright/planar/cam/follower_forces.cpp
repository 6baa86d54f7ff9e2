// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/follower_forces.h"

#include <cmath>

namespace linkwright::planar {
namespace {

using math::Motion;

double effort_at_rest(const Motion& m, const FollowerLoad& load) {
  return load.stiffness * m.value + load.preload + load.load;
}

double effort_of(const Motion& m, const FollowerLoad& load) {
  return load.inertia * m.acceleration * load.speed * load.speed + effort_at_rest(m, load);
}

}  // namespace

FollowerForces follower_forces(const CamState& state, const Motion& motion, const FollowerLoad& load) {
  const double effort = effort_of(motion, load);
  return {effort, state.lever > 0 ? effort / state.lever : nan, effort * motion.rate};
}

std::optional<CamExtreme> lift_off_speed(const ProgrammeCurve& curve, const FollowerLoad& load) {
  const CamExtreme least_at_rest =
      least_over(curve, [&load](const Motion& m, double) { return effort_at_rest(m, load); });
  if (least_at_rest.value < 0) return CamExtreme{0, least_at_rest.angle};
  const auto square_of_speed = [&load](const Motion& m, double) {
    return m.acceleration < 0 ? effort_at_rest(m, load) / (-load.inertia * m.acceleration) : infinity;
  };
  const CamExtreme square = least_over(curve, square_of_speed, EqualPlaces::last);
  if (!std::isfinite(square.value)) return std::nullopt;
  return CamExtreme{std::sqrt(square.value), square.angle};
}

CamExtreme needed_preload(const ProgrammeCurve& curve, const FollowerLoad& load) {
  FollowerLoad free = load;
  free.preload = 0;
  return greatest_over(curve, [&free](const Motion& m, double) { return -effort_of(m, free); });
}

std::vector<CamRange> ranges_without_contact(const ProgrammeCurve& curve, const FollowerLoad& load) {
  return negative_ranges(curve, [&load](const Motion& m, double) { return effort_of(m, load); });
}

}  // namespace linkwright::planar
