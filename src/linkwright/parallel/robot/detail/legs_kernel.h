// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <type_traits>

#include "linkwright/math/scalar.h"
#include "linkwright/parallel/robot/robot.h"

/// Formulas of one leg, written once for numbers and for SIMD batches.
namespace linkwright::parallel {

/// Arm and rod of a leg at a place of its platform joint.
template <class T>
struct LegAt {
  math::Vector3<T> arm;     ///< u: unit direction of the arm
  math::Vector3<T> normal;  ///< u' = du/dalpha
  math::Vector3<T> rod;     ///< s: from the arm's end to the platform joint (m)
  T cosine, sine;           ///< cosine and sine of alpha
  T reach;  ///< rho^2 - c^2 (m2): negative = the leg cannot reach the joint; 0 = arm and rod aligned
};

/// A place of the platform joint seen from the pivot of the arm, and how far the leg can reach.
template <class T>
struct JointSeen {
  math::Vector3<T> v;  ///< from the pivot (m)
  T along, aside;      ///< its parts along e and w (m)
  T square;            ///< rho^2 = along^2 + aside^2 (m2)
  T c;                 ///< part of it along the arm that reaches it: (v.v + l^2 - L^2) / (2 l) (m)
};
template <class T>
LINKWRIGHT_KERNEL JointSeen<T> joint_seen(const Leg& leg, const math::Vector3<T>& g) {
  JointSeen<T> out;
  out.v = g - leg.base;
  out.along = dot(out.v, leg.ahead);
  out.aside = dot(out.v, leg.aside);
  out.square = out.along * out.along + out.aside * out.aside;
  out.c = (dot(out.v, out.v) + (leg.arm * leg.arm - leg.rod * leg.rod)) * (0.5 / leg.arm);
  return out;
}

/// The arm that reaches the platform joint `g` with the working mode `sign` (of s . u', 1 or -1), without any
/// trigonometry: the law of cosines turned by the direction of the joint seen from the pivot. Where it cannot
/// reach, `reach` is negative (or NaN) and the rest is unusable.
template <class T>
LINKWRIGHT_KERNEL LegAt<T> leg_at(const Leg& leg, const math::Vector3<T>& g, double sign) {
  using std::sqrt;
  const JointSeen<T> seen = joint_seen(leg, g);
  const T &x = seen.along, &w = seen.aside, &square = seen.square, &c = seen.c;
  const math::Vector3<T>& v = seen.v;
  LegAt<T> out;
  out.reach = square - c * c;
  const T root = sign * sqrt(out.reach), inverse = 1.0 / square;
  out.cosine = (x * c + w * root) * inverse;
  out.sine = (w * c - x * root) * inverse;
  const auto along = [&](const T& a, const T& b) {
    return math::Vector3<T>{a * leg.ahead.x + b * leg.aside.x, a * leg.ahead.y + b * leg.aside.y,
                            a * leg.ahead.z + b * leg.aside.z};
  };
  out.arm = along(out.cosine, out.sine);
  out.normal = along(-out.sine, out.cosine);
  out.rod = {v.x - leg.arm * out.arm.x, v.y - leg.arm * out.arm.y, v.z - leg.arm * out.arm.z};
  return out;
}

/// The same leg with the arm at an angle given by its cosine and sine.
template <class T>
LINKWRIGHT_KERNEL LegAt<T> leg_turned(const Leg& leg, const math::Vector3<T>& g, const T& cosine,
                                      const T& sine) {
  LegAt<T> out;
  out.cosine = cosine;
  out.sine = sine;
  out.arm = {cosine * leg.ahead.x + sine * leg.aside.x, cosine * leg.ahead.y + sine * leg.aside.y,
             cosine * leg.ahead.z + sine * leg.aside.z};
  out.normal = {cosine * leg.aside.x - sine * leg.ahead.x, cosine * leg.aside.y - sine * leg.ahead.y,
                cosine * leg.aside.z - sine * leg.ahead.z};
  out.rod = {g.x - leg.base.x - leg.arm * out.arm.x, g.y - leg.base.y - leg.arm * out.arm.y,
             g.z - leg.base.z - leg.arm * out.arm.z};
  out.reach = T(0.0);
  return out;
}

/// f(integral constant of the number of legs).
template <class F>
auto sized(const Robot& robot, F&& f) {
  switch (robot.freedom) {
    case Freedom::plane_translation:
      return f(std::integral_constant<int, 2>{});
    case Freedom::space_translation:
      return f(std::integral_constant<int, 3>{});
    case Freedom::space:
      break;
  }
  return f(std::integral_constant<int, 6>{});
}

}  // namespace linkwright::parallel
