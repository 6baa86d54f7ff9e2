// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/regular_ball.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/singular_values.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/math/zero.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"

namespace linkwright::parallel {
namespace {

int sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

template <int N>
void measure_rods(const std::array<std::array<double, N>, N>& rows, RegularAt& out) {
  const auto values = math::singular_values<N, false>(rows).value;
  out.rods = *std::min_element(values.begin(), values.end());
  math::SmallLu<N> lu;
  lu.factor(rows);
  out.marks.assembly = sign_of(lu.determinant());
}

// Lower bound of q^2 where the platform joint has moved by r; not above 0: none.
double square_within(const RegularAt::Leg& leg, double arm, double r) {
  return leg.square - r * (2 * (leg.rho + r) +
                           2 / arm * (std::abs(leg.c) + r / arm * (leg.away + r / 2)) * (leg.away + r));
}

}  // namespace

RegularAt regular_at(const Robot& robot, const Pose& pose, const WorkingMode& mode, double length) {
  RegularAt out{.reach = infinity};
  std::array<Vec3, max_legs> rod, lever;
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    lever[i] = pose.rotation * leg.platform;
    const JointSeen<double> seen = joint_seen(leg, pose.position + lever[i]);
    const LegAt<double> at = leg_at(leg, pose.position + lever[i], mode[i]);
    out.legs[i] = {at.reach, std::sqrt(seen.square), seen.c, norm(seen.v)};
    rod[i] = (1 / leg.rod) * at.rod;
    if (!(at.reach > 0) && out.leg < 0) out.leg = i;
    out.reach = std::min(out.reach, at.reach / (leg.rod * leg.rod));
  }
  out.reached = out.leg < 0;
  if (!out.reached) return out;
  sized(robot, [&](auto size) {
    constexpr int n = size;
    std::array<std::array<double, n>, n> rows;
    for (int i = 0; i < n; ++i) {
      rows[i][0] = rod[i].x;
      rows[i][1] = rod[i].y;
      if constexpr (n > 2) rows[i][2] = rod[i].z;
      if constexpr (n == 6) {
        const Vec3 moment = (1 / length) * cross(lever[i], rod[i]);
        rows[i][3] = moment.x;
        rows[i][4] = moment.y;
        rows[i][5] = moment.z;
      }
    }
    measure_rods<n>(rows, out);
  });
  out.marks.constraint = 1;
  if (robot.freedom == Freedom::space_translation) {
    std::array<Vec3, 3> couple;
    std::array<std::array<double, 3>, 3> rows;
    for (int i = 0; i < 3; ++i) {
      couple[i] = cross(cross(robot.leg[i].ahead, robot.leg[i].aside), rod[i]);
      rows[i] = {couple[i].x, couple[i].y, couple[i].z};
    }
    const auto values = math::singular_values<3, false>(rows).value;
    out.constraint = *std::min_element(values.begin(), values.end());
    out.marks.constraint = sign_of(dot(couple[0], cross(couple[1], couple[2])));
  }
  return out;
}

double min_rods(const Robot& robot, const Jacobians& at, double length) {
  return sized(robot, [&](auto size) {
    constexpr int n = size;
    std::array<std::array<double, n>, n> rows;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) rows[i][k] = at.platform[i][k] / (robot.leg[i].rod * (k < 3 ? 1 : length));
    const auto values = math::singular_values<n, false>(rows).value;
    return *std::min_element(values.begin(), values.end());
  });
}

std::optional<double> change_within(const Robot& robot, const RegularAt& at, const Displaced& by,
                                    double length) {
  if (!at.reached) return {};
  const bool turns = robot.freedom == Freedom::space;
  double sum = 0;
  for (int i = 0; i < robot.legs(); ++i) {
    const double lever = turns ? norm(robot.leg[i].platform) : 0, turn = turns ? by.turn : 0;
    const double way = by.shift + lever * turn;
    const double square = square_within(at.legs[i], robot.leg[i].arm, way);
    if (!(square > 0)) return {};
    const double direction = way / std::sqrt(square);
    const double moment = lever / length * (direction + turn);
    sum += direction * direction + (turns ? moment * moment : 0);
  }
  return std::sqrt(sum);
}

double clear_radius(const Robot& robot, const RegularAt& at, double length) {
  if (!at.reached) return 0;
  const double spare = std::min(at.constraint - constraint_floor / 2, at.rods - rods_floor / 2);
  if (!(spare > 0)) return 0;
  // While q^2 keeps a quarter, 1/|q| at most doubles.
  const auto keeps = [&](double r) {
    for (int i = 0; i < robot.legs(); ++i)
      if (!(square_within(at.legs[i], robot.leg[i].arm, r) >= at.legs[i].square / 4)) return false;
    return true;
  };
  double sum = 0, high = 0;
  for (int i = 0; i < robot.legs(); ++i) {
    // The rows of turning of a HEXA move, too.
    const double rows =
        robot.freedom == Freedom::space ? std::hypot(1, norm(robot.leg[i].platform) / length) : 1;
    sum += rows * rows / at.legs[i].square;
    high = std::max(high, robot.leg[i].arm + robot.leg[i].rod);
  }
  return std::min(math::bisect(keeps, 0, high, {.halvings = 40}).inside, spare / (2 * std::sqrt(sum)));
}

}  // namespace linkwright::parallel
