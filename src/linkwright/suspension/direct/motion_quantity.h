// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "linkwright/suspension/compliance/spring_law.h"
#include "linkwright/suspension/wheel/derivatives.h"

/// Numbers of springs, dampers and bars at the wheel that targets of a wheel suspension may prescribe.
namespace linkwright::suspension {

/// The length or angle that a number follows from.
enum class MotionPart { spring, element, rocker };

/// How it follows from the length or angle l along the travel z of the wheel centre.
enum class MotionMeasure {
  ratio,            ///< factor times dl/dz
  ratio_by_travel,  ///< factor times d2l/dz2
  ratio_squared,    ///< factor times (dl/dz)^2: damping at the wheel, rate of a U bar
  spring_force,     ///< F of the law
  wheel_force,      ///< -F dl/dz
  wheel_rate        ///< k (dl/dz)^2 - F d2l/dz2
};

/// A number of a spring, a damper or a bar.
struct MotionQuantity {
  MotionPart part = MotionPart::spring;
  std::size_t index = 0;  ///< index of the element or rocker
  MotionMeasure measure = MotionMeasure::ratio;
  double factor = 1;
  /// Force by compression from the drawing; of an element's or rocker's angle by -factor times the angle.
  SpringLaw law;
};

/// The number at a position.
///
/// @param quantity the number
/// @param at motions of the position
/// @returns its value; NaN where the part is not known
double value_of(const MotionQuantity& quantity, const MotionRates& at);

/// Its derivative by a number of the design. The force of a spring at the drawing stays as it is.
///
/// @param quantity the number
/// @param at motions of the position
/// @param by derivatives of the motions
/// @returns the derivative
double derivative_of(const MotionQuantity& quantity, const MotionRates& at, const MotionRates& by);

}  // namespace linkwright::suspension
