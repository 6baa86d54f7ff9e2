// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/anti_roll.h"

#include <array>

#include "linkwright/suspension/compliance/t_bar.h"

namespace linkwright::suspension {
namespace {

/// The end of the droplink on the part that moves it, as its wheel travels by `share` of a path.
PathPoint droplink_end(const CornerMotions& motions, std::size_t rocker, double share) {
  const auto& [x, y, z] = motions.rod_ends.at(rocker);
  return {{x.value, y.value, z.value},
          share * Vec3{x.ratio, y.ratio, z.ratio},
          share * share * Vec3{x.by_travel, y.by_travel, z.by_travel}};
}

PathPoint mirrored(const PathPoint& point) {
  return {math::mirrored(point.at), math::mirrored(point.rate), math::mirrored(point.change)};
}

void take_side(TBar& bar, std::size_t side, const Rocker& rocker, bool mirror) {
  bar.end[side] = mirror ? math::mirrored(rocker.rod) : rocker.rod;
  bar.rod[side] = rocker.length.value_or(norm(rocker.rod - rocker.driven_by.at));
}

BarTwist twist_of(const TBar& bar, const std::array<PathPoint, 2>& other, double tilt) {
  const TBarPosition at = t_bar_position(bar, other, tilt);
  if (at.status != Status::done) return {};
  return {at.twist, at.twist_rate, at.twist_change, at.tilt};
}

}  // namespace

BarTwist bar_twist(const AxleDescription& both, const CornerMotions& left, const CornerMotions& right,
                   double left_share, double right_share) {
  const AntiRollBarDescription &one = *both.left.springs.anti_roll_bar,
                               &other = *both.right.springs.anti_roll_bar;
  const TravelRates &l = left.rockers.at(one.rocker), &r = right.rockers.at(other.rocker);
  if (!one.post_top)
    return {l.value - r.value, left_share * l.ratio - right_share * r.ratio,
            left_share * left_share * l.by_travel - right_share * right_share * r.by_travel};
  const Rocker &left_arm = both.left.suspension.rockers.at(one.rocker),
               &right_arm = both.right.suspension.rockers.at(other.rocker);
  TBar bar{.foot = left_arm.axis[0], .top = *one.post_top, .end = {}};
  take_side(bar, 0, left_arm, false);
  take_side(bar, 1, right_arm, false);
  return twist_of(
      bar, {droplink_end(left, one.rocker, left_share), droplink_end(right, other.rocker, right_share)},
      (l.value + r.value) / 2);
}

double anti_roll_rate(const CornerDescription& corner, const CornerMotions& here) {
  const AntiRollBarDescription& bar = *corner.springs.anti_roll_bar;
  const TravelRates& arm = here.rockers.at(bar.rocker);
  double by_travel = 2 * arm.ratio;
  if (bar.post_top) {
    const Rocker& rocker = corner.suspension.rockers.at(bar.rocker);
    TBar whole{.foot = rocker.axis[0], .top = *bar.post_top, .end = {}};
    take_side(whole, 0, rocker, false);
    take_side(whole, 1, rocker, true);
    by_travel =
        twist_of(whole, {droplink_end(here, bar.rocker, 1), mirrored(droplink_end(here, bar.rocker, -1))},
                 arm.value)
            .by_travel;
  }
  return bar.stiffness * by_travel * by_travel / 2;
}

}  // namespace linkwright::suspension
