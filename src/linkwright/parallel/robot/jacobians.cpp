// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/sincos.h"
#include "linkwright/math/singular_values.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"
#include "linkwright/parallel/robot/robot.h"

namespace linkwright::parallel {

namespace {

template <int N>
using Square = std::array<std::array<double, N>, N>;

template <int N>
math::SmallLu<N> factored(const Matrix6& matrix) {
  math::SmallLu<N> out;
  out.factor(matrix);
  return out;
}

Vec3 platform_speed(const Robot& robot, const Jacobians& at, int leg, const Vector6& twist) {
  Vec3 v{twist[0], twist[1], 0};
  if (robot.freedom == Freedom::plane_translation) return v;
  v.z = twist[2];
  if (robot.freedom == Freedom::space) v += cross(Vec3{twist[3], twist[4], twist[5]}, at.lever[leg]);
  return v;
}

double dimensionless_determinant(const Robot& robot, const Jacobians& at, double length) {
  Matrix6 rows = at.platform;
  for (int i = 0; i < robot.legs(); ++i)
    for (int j = 0; j < robot.legs(); ++j) rows[i][j] /= robot.leg[i].rod * (j < 3 ? 1 : length);
  return sized(robot, [&](auto size) { return factored<size>(rows).determinant(); });
}

}  // namespace

Vector6 solve(const Robot& robot, const Matrix6& matrix, const Vector6& right) {
  return sized(robot, [&](auto size) {
    constexpr int n = size;
    std::array<double, n> b;
    for (int i = 0; i < n; ++i) b[i] = right[i];
    const auto x = factored<n>(matrix).solve(b);
    Vector6 out{};
    for (int i = 0; i < n; ++i) out[i] = x[i];
    return out;
  });
}

Matrix6 transposed(const Robot& robot, const Matrix6& matrix) {
  Matrix6 out{};
  for (int i = 0; i < robot.legs(); ++i)
    for (int k = 0; k < robot.legs(); ++k) out[i][k] = matrix[k][i];
  return out;
}

Jacobians jacobians(const Robot& robot, const Pose& pose, std::span<const double> angles) {
  LINKWRIGHT_REQUIRE(static_cast<int>(angles.size()) >= robot.legs(), "needs {} arm angles, got {}",
                     robot.legs(), angles.size());
  Jacobians out;
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    out.lever[i] = pose.rotation * leg.platform;
    double sine = 0, cosine = 0;
    math::sincos_of_any(angles[i], sine, cosine);
    const auto at = leg_turned(leg, pose.position + out.lever[i], cosine, sine);
    const Vec3& s = out.rod[i] = at.rod;
    out.arm[i] = at.arm;
    out.normal[i] = at.normal;
    out.drive[i] = leg.arm * dot(s, at.normal);
    out.platform[i] = {s.x, s.y, s.z};
    if (robot.freedom == Freedom::space) {
      const Vec3 moment = cross(out.lever[i], s);
      out.platform[i] = {s.x, s.y, s.z, moment.x, moment.y, moment.z};
    }
  }
  return out;
}

Matrix6 jacobian(const Robot& robot, const Jacobians& at) {
  return sized(robot, [&](auto size) {
    constexpr int n = size;
    const auto lu = factored<n>(at.platform);
    Matrix6 out{};
    for (int j = 0; j < n; ++j) {
      std::array<double, n> right{};
      right[j] = at.drive[j];
      const auto x = lu.solve(right);
      for (int i = 0; i < n; ++i) out[i][j] = x[i];
    }
    return out;
  });
}

double determinant(const Robot& robot, const Matrix6& matrix) {
  return sized(robot, [&](auto size) { return factored<size>(matrix).determinant(); });
}

double determinant(const Robot& robot, const Jacobians& at) { return determinant(robot, at.platform); }

Vector6 components(const Robot& robot, const Vec3& linear, const Vec3& angular) {
  switch (robot.freedom) {
    case Freedom::plane_translation:
      return {linear.x, linear.y};
    case Freedom::space_translation:
      return {linear.x, linear.y, linear.z};
    case Freedom::space:
      break;
  }
  return {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
}

Twist twist(const Robot& robot, const Vector6& t) {
  switch (robot.freedom) {
    case Freedom::plane_translation:
      return {{t[0], t[1], 0}, {}};
    case Freedom::space_translation:
      return {{t[0], t[1], t[2]}, {}};
    case Freedom::space:
      break;
  }
  return {{t[0], t[1], t[2]}, {t[3], t[4], t[5]}};
}

Vector6 arm_speeds(const Robot& robot, const Jacobians& at, const Twist& velocity) {
  Vector6 out{};
  for (int i = 0; i < robot.legs(); ++i)
    out[i] = dot(at.rod[i], velocity.linear + cross(velocity.angular, at.lever[i])) / at.drive[i];
  return out;
}

Vector6 arm_accelerations(const Robot& robot, const Jacobians& at, const Twist& velocity,
                          const Twist& acceleration) {
  const Vector6 speed = arm_speeds(robot, at, velocity);
  Vector6 out{};
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    const Vec3 turning = cross(velocity.angular, at.lever[i]);
    const Vec3 joint =
        acceleration.linear + cross(acceleration.angular, at.lever[i]) + cross(velocity.angular, turning);
    const Vec3 rod = velocity.linear + turning - leg.arm * speed[i] * at.normal[i];
    out[i] =
        (dot(at.rod[i], joint) + leg.arm * speed[i] * speed[i] * dot(at.rod[i], at.arm[i]) + dot(rod, rod)) /
        at.drive[i];
  }
  return out;
}

Twist platform_velocity(const Robot& robot, const Jacobians& at, std::span<const double> arm_speeds) {
  Vector6 right{};
  for (int i = 0; i < robot.legs(); ++i) right[i] = at.drive[i] * arm_speeds[i];
  return twist(robot, solve(robot, at.platform, right));
}

Quality quality(const Robot& robot, const Jacobians& at, double characteristic_length) {
  Quality out;
  out.transmission = infinity;
  out.rods = dimensionless_determinant(robot, at, characteristic_length);
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    out.input[i] = at.drive[i] / (leg.arm * leg.rod);
    Vector6 alone{};
    alone[i] = 1;
    const Vec3 v = platform_speed(robot, at, i, solve(robot, at.platform, alone));
    const double speed = norm(v);
    out.output[i] = std::isfinite(speed) ? 1 / (leg.rod * speed) : 0;
    out.transmission = std::min({out.transmission, std::abs(out.input[i]), out.output[i]});
  }
  out.constraint = robot.freedom == Freedom::space ? nan : 1;
  out.constraint_index = out.constraint;
  if (robot.freedom == Freedom::space_translation) {
    const Constraint held = constraint(robot, at);
    out.constraint = held.unit_determinant;
    out.constraint_index = held.index;
  }
  sized(robot, [&](auto size) {
    constexpr int n = size;
    const Matrix6 j = jacobian(robot, at);
    Square<n> scaled;
    for (int row = 0; row < n; ++row)
      for (int k = 0; k < n; ++k) scaled[row][k] = j[row][k] * (row < 3 ? 1 : characteristic_length);
    auto values = math::singular_values<n>(scaled).value;
    std::sort(values.begin(), values.end(), std::greater<>());
    out.manipulability = 1;
    for (int k = 0; k < n; ++k) {
      out.singular_value[k] = values[k];
      out.manipulability *= values[k];
    }
    out.condition = std::isfinite(values[0]) && values[n - 1] > 0 ? values[0] / values[n - 1] : infinity;
  });
  return out;
}

double platform_size(const Robot& robot) {
  double sum = 0;
  for (int i = 0; i < robot.legs(); ++i) sum += norm(robot.leg[i].platform);
  return sum > 0 ? sum / robot.legs() : 1;
}

Singularity singularity(const Robot& robot, const Quality& quality, double limit) {
  const auto aligned = [&](double input) { return std::abs(input) <= limit; };
  const bool first = std::any_of(quality.input.begin(), quality.input.begin() + robot.legs(), aligned);
  const bool second = !(std::abs(quality.rods) > limit);
  if (first && second) return Singularity::type3;
  if (first) return Singularity::type1;
  if (second) return Singularity::type2;
  if (quality.constraint_index <= constraint_floor) return Singularity::constraint;
  return Singularity::none;
}

}  // namespace linkwright::parallel
