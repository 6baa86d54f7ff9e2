// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/led_arms.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/robot/regular_ball.h"

namespace linkwright::parallel {
namespace {

constexpr double longest_step = 1.0 / 16;  // share of the path
constexpr double max_turn = 0.1;           // rad of an arm, in a step
constexpr double shortest_step = 1e-9;
constexpr double close = 0.2;  // share of a step's displacement that Newton's method may add to it
constexpr int max_steps = 100000;

/// The distance of two poses (m), rotation as displacement at a length.
double distance(const Pose& a, const Pose& b, double length) {
  const double turn = norm(math::turn_of(a.rotation * transposed(b.rotation)));
  return std::hypot(norm(a.position - b.position), length * turn);
}

}  // namespace

LedPose lead_arms(const Robot& robot, const Pose& home, std::span<const double> home_angles,
                  std::span<const double> angles, double length) {
  const int n = robot.legs();
  LINKWRIGHT_REQUIRE(static_cast<int>(home_angles.size()) >= n && static_cast<int>(angles.size()) >= n,
                     "{} arms at home and {} angles for {} legs", home_angles.size(), angles.size(), n);
  Vector6 rate{}, at_angles{};
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    rate[i] = math::wrap_angle(angles[i] - home_angles[i]);
    largest = std::max(largest, std::abs(rate[i]));
    at_angles[i] = home_angles[i];
  }
  LedPose out{.pose = home};
  Jacobians at = jacobians(robot, home, at_angles);
  const bool positive = determinant(robot, at) > 0;
  LINKWRIGHT_REQUIRE(min_rods(robot, at, length) >= rods_floor, "the robot is singular at home");
  double step = std::min(longest_step, max_turn / std::max(largest, 1e-300));
  bool held = true;  // true if something other than a singularity made the last step shorter
  while (out.share < 1) {
    if (step < shortest_step || ++out.steps > max_steps) {
      out.status = held ? Status::not_converged : Status::singular;
      return out;
    }
    const double share = std::min(1.0, out.share + step);
    for (int i = 0; i < n; ++i)
      at_angles[i] = share == 1 ? home_angles[i] + rate[i] : home_angles[i] + share * rate[i];
    const Twist velocity = platform_velocity(robot, at, rate);
    const double by = share - out.share;
    Pose ahead{out.pose.position + by * velocity.linear, out.pose.rotation};
    if (robot.freedom == Freedom::space)
      ahead.rotation = math::turn_about(by * velocity.angular) * out.pose.rotation;
    const Placed placed = direct_near(robot, at_angles, ahead);
    const double went = distance(out.pose, ahead, length);
    const bool follows =
        placed.status == Status::done && distance(placed.pose, ahead, length) <= close * went + 1e-12;
    if (follows) {
      const Jacobians there = jacobians(robot, placed.pose, at_angles);
      held = min_rods(robot, there, length) >= rods_floor && (determinant(robot, there) > 0) == positive;
      if (held) {
        out.pose = placed.pose;
        out.residual = placed.residual;
        out.share = share;
        at = there;
        step = std::min({2 * step, longest_step, max_turn / std::max(largest, 1e-300)});
        continue;
      }
    } else {
      held = min_rods(robot, at, length) > 10 * rods_floor;
    }
    step /= 2;
  }
  return out;
}

}  // namespace linkwright::parallel
