// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/motion.h"

/// @file
/// The laws of struts: forces between two points. A spring is one with a law of its own, see LinearSpring.
namespace linkwright::planar {

/// The line between two points of a linkage.
struct Span {
  math::Vec2 first{0, 0},  ///< one end, global, m
      second{0, 0};        ///< the other end, global, m
  math::Vec2 along{0, 0};  ///< unit vector from the first end to the second; zero where they coincide
  double length = 0;       ///< m
  double rate = 0;         ///< speed at which it becomes longer, m/s; after solve_velocity
};

/// The line between two points of bodies at the present motion.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion
/// @param first one end
/// @param second the other end
/// @returns the line
Span span_of(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
             const BodyPoint& first, const BodyPoint& second);

/// The force of a strut.
///
/// @param strut the strut
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, velocities included
/// @param span the line between its ends
/// @param time time (s)
/// @param input value of the first input (rad or m)
/// @returns force (N), positive where it pushes its ends apart; that of a gas spring beyond its stroke goes
///   on linearly
double push_of(const Strut& strut, const Linkage& linkage, const LinkagePlan& plan,
               const LinkageMotion& motion, const Span& span, double time, double input);

/// True if the force of a strut depends on its length alone, so that it stores energy.
///
/// @param strut the strut
/// @returns true if it stores energy
bool stores_energy(const Strut& strut);

/// Energy that a strut stores.
///
/// @param strut the strut
/// @param length distance of its ends (m)
/// @returns energy (J): zero at the extended length of a gas spring, at the first length of a table, and at
///   no length for a constant force; zero of a strut that stores none
double stored_energy(const Strut& strut, double length);

/// True if a strut is a gas spring that is shorter or longer than its stroke allows.
///
/// @param strut the strut
/// @param length distance of its ends (m)
/// @returns true if it cannot have that length
bool beyond_stroke(const Strut& strut, double length);

/// A load without a value: a gas spring beyond its stroke, or a formula that has none. The linkage owns what
/// it refers to.
struct LoadWithoutValue {
  const Strut* strut = nullptr;        ///< the strut, if it is one
  const PointForce* force = nullptr;   ///< the force, if it is one
  const BodyTorque* torque = nullptr;  ///< the torque, if it is one
  double length = 0;                   ///< distance of the ends of a strut (m)
  /// @returns true if there is such a load
  explicit operator bool() const { return strut || force || torque; }
};

/// The first load without a value.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, velocities included
/// @param time time (s)
/// @returns the load; none if all have values
LoadWithoutValue load_without_value(const Linkage& linkage, const LinkagePlan& plan,
                                    const LinkageMotion& motion, double time);

/// The reason why a load has no value, for messages: "gas spring 's' would be 270 mm long; it goes from 276
/// to 356 mm".
///
/// @param load a load of `load_without_value`
/// @returns the sentence
Sentence without_value_text(const LoadWithoutValue& load);

}  // namespace linkwright::planar
