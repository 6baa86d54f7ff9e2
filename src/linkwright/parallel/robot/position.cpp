// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/sincos.h"
#include "linkwright/math/small_lu.h"
#include "linkwright/parallel/robot/detail/legs_kernel.h"
#include "linkwright/parallel/robot/robot.h"

namespace linkwright::parallel {

namespace {

// The rounding error of rho^2 - c^2, relative to the squares of the lengths.
constexpr double position_rounding = 8 * std::numeric_limits<double>::epsilon();

// The distance of the joint from the reach of the leg: its distance to the nearest and the farthest point of
// the elbow's circle, against the rod.
double shortfall_of(const Leg& leg, const Vec3& g) {
  const Vec3 v = g - leg.base;
  const double rho = std::hypot(dot(v, leg.ahead), dot(v, leg.aside));
  const double off = dot(v, cross(leg.ahead, leg.aside));
  const double nearest = std::hypot(rho - leg.arm, off), farthest = std::hypot(rho + leg.arm, off);
  if (leg.rod < nearest) return nearest - leg.rod;
  return std::min(0.0, farthest - leg.rod);
}

struct Residuals {
  std::array<Vec3, max_legs> rod, lever;
  std::array<double, max_legs> value{};  // (|s|^2 - L^2)/2
  double largest = 0;                    // largest |value|
};

Residuals residuals(const Robot& robot, const std::array<Vec3, max_legs>& elbows, const Pose& pose) {
  Residuals out;
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    out.lever[i] = pose.rotation * leg.platform;
    out.rod[i] = pose.position + out.lever[i] - elbows[i];
    out.value[i] = 0.5 * (dot(out.rod[i], out.rod[i]) - leg.rod * leg.rod);
    out.largest = std::max(out.largest, std::abs(out.value[i]));
  }
  return out;
}

template <int N>
using Rows = std::array<std::array<double, N>, N>;

/// f(Jx) of the robot's size.
template <class F>
auto with_rows(const Robot& robot, const Residuals& at, F&& f) {
  const auto& s = at.rod;
  switch (robot.freedom) {
    case Freedom::plane_translation: {
      Rows<2> rows;
      for (int i = 0; i < 2; ++i) rows[i] = {s[i].x, s[i].y};
      return f(std::integral_constant<int, 2>{}, rows);
    }
    case Freedom::space_translation: {
      Rows<3> rows;
      for (int i = 0; i < 3; ++i) rows[i] = {s[i].x, s[i].y, s[i].z};
      return f(std::integral_constant<int, 3>{}, rows);
    }
    case Freedom::space:
      break;
  }
  Rows<6> rows;
  for (int i = 0; i < 6; ++i) {
    const Vec3 m = cross(at.lever[i], s[i]);
    rows[i] = {s[i].x, s[i].y, s[i].z, m.x, m.y, m.z};
  }
  return f(std::integral_constant<int, 6>{}, rows);
}

// x of Jx x = -value, as a shift and a turn, and the sign of det Jx.
struct Step {
  Vec3 shift{}, turn{};
  bool positive = false;
};

Step newton_step(const Robot& robot, const Residuals& at) {
  return with_rows(robot, at, [&](auto size, const auto& rows) {
    constexpr int N = size;
    std::array<double, N> right;
    for (int i = 0; i < N; ++i) right[i] = -at.value[i];
    math::SmallLu<N> lu;
    lu.factor(rows);
    const auto x = lu.solve(right);
    Step out{.shift = {x[0], x[1], 0}, .positive = lu.determinant() > 0};
    if constexpr (N > 2) out.shift.z = x[2];
    if constexpr (N == 6) out.turn = {x[3], x[4], x[5]};
    return out;
  });
}

bool positive_determinant(const Robot& robot, const Residuals& at) {
  return with_rows(robot, at, [](auto size, const auto& rows) {
    math::SmallLu<size> lu;
    lu.factor(rows);
    return lu.determinant() > 0;
  });
}

std::array<Vec3, max_legs> elbows_of(const Robot& robot, std::span<const double> angles) {
  LINKWRIGHT_REQUIRE(static_cast<int>(angles.size()) >= robot.legs(), "needs {} arm angles, got {}",
                     robot.legs(), angles.size());
  std::array<Vec3, max_legs> out;
  for (int i = 0; i < robot.legs(); ++i) out[i] = elbow(robot.leg[i], angles[i]);
  return out;
}

double length_error(const Robot& robot, const Residuals& at) {
  double out = 0;
  for (int i = 0; i < robot.legs(); ++i) out = std::max(out, std::abs(norm(at.rod[i]) - robot.leg[i].rod));
  return out;
}

// The square of a height over the plane or the line of the centres; slightly negative is taken as none.
double height(double square, double scale) {
  if (square >= 0) return std::sqrt(square);
  return square > -position_rounding * scale ? 0.0 : nan;
}

}  // namespace

std::vector<WorkingMode> working_modes(const Robot& robot) {
  std::vector<WorkingMode> out;
  for (int bits = 0; bits < 1 << robot.legs(); ++bits) {
    WorkingMode mode = all_positive;
    for (int i = 0; i < robot.legs(); ++i)
      if (bits >> i & 1) mode[i] = -1;
    out.push_back(mode);
  }
  return out;
}

Vec3 platform_joint(const Robot& robot, int leg, const Pose& pose) {
  return pose.position + pose.rotation * robot.leg[leg].platform;
}

Vec3 elbow(const Leg& leg, double angle) {
  double sine = 0, cosine = 0;
  math::sincos_of_any(angle, sine, cosine);
  return leg.base + leg.arm * (cosine * leg.ahead + sine * leg.aside);
}

ArmAngles inverse(const Robot& robot, const Pose& pose, const WorkingMode& mode) {
  ArmAngles out;
  const auto fail = [&](int leg, Status status) {
    out.angle[leg] = nan;
    if (out.leg >= 0) return;
    out.leg = leg;
    out.status = status;
    out.shortfall = shortfall_of(robot.leg[leg], platform_joint(robot, leg, pose));
  };
  for (int i = 0; i < robot.legs(); ++i) {
    const Leg& leg = robot.leg[i];
    const Vec3 v = pose.position + pose.rotation * leg.platform - leg.base;
    const double x = dot(v, leg.ahead), w = dot(v, leg.aside), square = x * x + w * w;
    const double c = (dot(v, v) + leg.arm * leg.arm - leg.rod * leg.rod) / (2 * leg.arm);
    double reach = square - c * c;
    const double scale = leg.arm * leg.arm + leg.rod * leg.rod;
    if (square <= position_rounding * position_rounding * scale) {
      // On the arm's axis: every angle, or none.
      fail(i, std::abs(c) <= position_rounding * leg.rod ? Status::singular : Status::no_assembly);
      continue;
    }
    if (reach < 0 && reach > -position_rounding * scale) reach = 0;
    if (!(reach >= 0)) {
      fail(i, Status::no_assembly);
      continue;
    }
    const double root = mode[i] * std::sqrt(reach);
    out.angle[i] = std::atan2(w * c - x * root, x * c + w * root);
  }
  return out;
}

WorkingMode working_mode(const Robot& robot, const Pose& pose, std::span<const double> angles) {
  WorkingMode out = all_positive;
  for (int i = 0; i < robot.legs(); ++i) {
    const auto at =
        leg_turned(robot.leg[i], platform_joint(robot, i, pose), std::cos(angles[i]), std::sin(angles[i]));
    const double side = dot(at.rod, at.normal);
    out[i] = side > 0 ? 1 : side < 0 ? -1 : 0;
  }
  return out;
}

Placed direct(const Robot& robot, std::span<const double> angles, int assembly) {
  LINKWRIGHT_REQUIRE(robot.freedom != Freedom::space, "a robot that turns has no closed form");
  std::array<Vec3, max_legs> centre = elbows_of(robot, angles);
  for (int i = 0; i < robot.legs(); ++i) centre[i] = centre[i] - robot.leg[i].platform;
  const auto square = [](double a) { return a * a; };
  const auto rod = [&](int i) { return robot.leg[i].rod; };

  Placed out;
  const Vec3 across = centre[1] - centre[0];
  const double distance = norm(across), scale = square(rod(0)) + square(rod(1));
  if (distance <= position_rounding * (rod(0) + rod(1))) {
    out.status = Status::singular;  // the first two spheres have one centre
    return out;
  }
  const Vec3 ex = (1 / distance) * across;
  const double x = (square(rod(0)) - square(rod(1)) + square(distance)) / (2 * distance);
  if (robot.freedom == Freedom::plane_translation) {
    const double h = height(square(rod(0)) - square(x), scale);
    out.pose.position = centre[0] + x * ex + assembly * h * Vec3{-ex.y, ex.x, 0};
  } else {
    const Vec3 third = centre[2] - centre[0];
    const double i = dot(ex, third);
    const Vec3 rest = third - i * ex;
    const double j = norm(rest);
    if (j <= position_rounding * (distance + norm(third))) {
      out.status = Status::singular;  // three centres on a line
      return out;
    }
    const Vec3 ey = (1 / j) * rest;
    const double y = (square(rod(0)) - square(rod(2)) + square(i) + square(j)) / (2 * j) - i / j * x;
    const double z = height(square(rod(0)) - square(x) - square(y), scale);
    out.pose.position = centre[0] + x * ex + y * ey + assembly * z * cross(ex, ey);
  }
  if (!std::isfinite(out.pose.position.x)) {
    out.status = Status::no_assembly;
    return out;
  }
  for (int i = 0; i < robot.legs(); ++i)
    out.residual = std::max(out.residual, std::abs(norm(out.pose.position - centre[i]) - rod(i)));
  return out;
}

Placed direct_near(const Robot& robot, std::span<const double> angles, const Pose& start) {
  const std::array<Vec3, max_legs> elbows = elbows_of(robot, angles);
  double scale = 0;
  for (int i = 0; i < robot.legs(); ++i) scale = std::max(scale, robot.leg[i].rod * robot.leg[i].rod);
  // Quadratic convergence continues to where rounding stops it; a pose counts when it is near that.
  const double goal = 1e-15 * scale, enough = 1e-12 * scale;

  Placed out{.pose = start};
  Residuals at = residuals(robot, elbows, out.pose);
  constexpr int max_iterations = 50;
  bool positive = false;  // det Jx at the start
  while (at.largest > goal && out.iterations < max_iterations) {
    ++out.iterations;
    const Step step = newton_step(robot, at);
    if (out.iterations == 1) positive = step.positive;
    bool better = false;
    for (double part = 1; part > 1e-3 && !better; part /= 2) {
      Pose next{out.pose.position + part * step.shift, out.pose.rotation};
      if (robot.freedom == Freedom::space)
        next.rotation = math::turn_about(part * step.turn) * out.pose.rotation;
      const Residuals there = residuals(robot, elbows, next);
      if ((better = there.largest < at.largest)) {
        out.pose = next;
        at = there;
      }
    }
    if (!better) break;
  }
  out.residual = length_error(robot, at);
  if (!(at.largest <= enough))
    out.status = Status::not_converged;
  else if (out.iterations > 0 && positive_determinant(robot, at) != positive)
    out.status = Status::branch_lost;
  return out;
}

Sentence reason(const ArmAngles& angles) {
  if (angles.status == Status::done) return {};
  const Measured leg = at_place("leg", count_of(angles.leg + 1));
  if (angles.status == Status::singular)
    return say("the platform joint of leg {} is on the axis of its arm, whose angle is open", leg);
  return say("leg {} is {} too {}", leg, millimetres(std::abs(angles.shortfall)),
             angles.shortfall >= 0 ? "short" : "long");
}

}  // namespace linkwright::parallel
